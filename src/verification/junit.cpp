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

}  // namespace

void write_junit(std::ostream& out, const std::vector<Deviation>& deviations) {
  const auto failures = std::count_if(deviations.begin(), deviations.end(), [](const Deviation& d) { return !d.passed(); });
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  out << fmt::format(
      "<testsuites>\n  <testsuite name=\"lanescape verify\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\">\n",
      deviations.size(), failures);
  for (const Deviation& d : deviations) {
    out << fmt::format("    <testcase classname=\"{}\" name=\"{}\"", escape(d.isa), escape(d.kernel));
    if (d.passed())
      out << "/>\n";
    else
      out << fmt::format(">\n      <failure message=\"{}\"/>\n    </testcase>\n", escape(describe(d)));
  }
  out << "  </testsuite>\n</testsuites>\n";
}

}  // namespace lanescape
