#pragma once

#include <optional>
#include <string>

#include "io/atomic_file.hpp"
#include "json.hpp"
#include "verification/host_results.hpp"
#include "verification/junit.hpp"

namespace lanescape::program {

// The report of a host's kernel as it is printed: counts of cases, the worst deviation of each quantity, the failures.
Json to_json(const HostReport& report, HostPrecision precision);

// The file of --junit, or none. Made before the work, because a path that cannot be written is bad input.
class JunitFile {
 public:
  explicit JunitFile(const std::string& path) {
    if (!path.empty()) file_.emplace(path);
  }
  // Report: what write_junit() takes.
  template <class Report>
  void write(const Report& report) {
    if (!file_) return;
    file_->write([&](std::ostream& out) { write_junit(out, report); });
    file_->commit();
  }

 private:
  std::optional<TemporaryFile> file_;
};

}  // namespace lanescape::program
