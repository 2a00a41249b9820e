#include "verification/junit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <string_view>

namespace lanescape {
namespace {

// Escapes text for attributes. XML 1.0 cannot represent the other control characters, so they become question marks.
std::string escape(std::string_view text) {
  std::string escaped;
  for (const char c : text) switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&apos;";
        break;
      case '\n':
        escaped += "&#10;";
        break;
      case '\t':
        escaped += "&#9;";
        break;
      case '\r':
        escaped += "&#13;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  return escaped;
}

struct TestCase {
  std::string classname, name;
  std::string failure{}, skipped{};  // why; at most one of them
};

void write(std::ostream& out, const std::vector<TestCase>& cases) {
  const auto failures = std::count_if(cases.begin(), cases.end(), [](const TestCase& t) { return !t.failure.empty(); });
  const auto skipped = std::count_if(cases.begin(), cases.end(), [](const TestCase& t) { return !t.skipped.empty(); });
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  out << fmt::format(
      "<testsuites>\n  <testsuite name=\"lanescape verify\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n",
      cases.size(), failures, skipped);
  for (const TestCase& t : cases) {
    out << fmt::format("    <testcase classname=\"{}\" name=\"{}\"", escape(t.classname), escape(t.name));
    if (!t.failure.empty())
      out << fmt::format(">\n      <failure message=\"{}\"/>\n    </testcase>\n", escape(t.failure));
    else if (!t.skipped.empty())
      out << fmt::format(">\n      <skipped message=\"{}\"/>\n    </testcase>\n", escape(t.skipped));
    else
      out << "/>\n";
  }
  out << "  </testsuite>\n</testsuites>\n";
}

TestCase test_case_of(const HostVerdict& verdict) {
  TestCase one{"host kernel", verdict.name};
  switch (verdict.outcome) {
    case HostOutcome::passed:
      break;
    case HostOutcome::failed:
      one.failure = verdict.message;
      break;
    case HostOutcome::declined:
      one.skipped = "declined";
      break;
    case HostOutcome::missing:
      one.skipped = "no result";
      break;
    case HostOutcome::left_out:
      one.skipped = "a pair at the cutoff, in single precision";
      break;
  }
  return one;
}

}  // namespace

void write_junit(std::ostream& out, const std::vector<Deviation>& deviations) {
  std::vector<TestCase> cases;
  for (const Deviation& d : deviations) cases.push_back({d.isa, d.kernel, d.passed() ? "" : describe(d)});
  write(out, cases);
}

void write_junit(std::ostream& out, const HostReport& report) {
  std::vector<TestCase> cases;
  for (const HostVerdict& verdict : report.verdicts) cases.push_back(test_case_of(verdict));
  // A suite of skipped tests alone would pass.
  if (report.count(HostOutcome::passed) + report.count(HostOutcome::failed) == 0)
    cases.push_back({"host kernel", "some case is compared", report.summary()});
  write(out, cases);
}

}  // namespace lanescape
