#include "host_report.hpp"

namespace lanescape::program {
namespace {

// Numbers that are not finite become null.
Json to_json(const HostDeviation& d) {
  Json json = {{"quantity", d.quantity}, {"cases", d.cases}, {"worst", number_or_null(d.worst)}, {"tolerance", d.tolerance}};
  json["worst_case"] = d.worst_case;
  if (!d.worst_case.empty()) {
    if (d.is_vector()) {
      json["particle"] = d.component / 3;
      json["component"] = std::string(1, "xyz"[d.component % 3]);
    }
    json["expected"] = number_or_null(d.expected);
    json["got"] = number_or_null(d.got);
  }
  json["passed"] = d.worst <= d.tolerance;
  return json;
}

}  // namespace

Json to_json(const HostReport& report, HostPrecision precision) {
  Json json;
  json["passed"] = report.passed();
  json["precision"] = to_string(precision);
  json["cases"] = report.verdicts.size();
  json["compared"] = report.count(HostOutcome::passed) + report.count(HostOutcome::failed);
  json["failed"] = report.count(HostOutcome::failed);
  json["declined"] = report.count(HostOutcome::declined);
  json["missing"] = report.count(HostOutcome::missing);
  json["left_out"] = report.count(HostOutcome::left_out);
  json["summary"] = report.summary();
  for (const HostDeviation& d : report.quantities) json["quantities"].push_back(to_json(d));
  json["failures"] = Json::array();
  for (const HostVerdict& v : report.verdicts)
    if (v.outcome == HostOutcome::failed) json["failures"].push_back({{"case", v.name}, {"message", v.message}});
  return json;
}

}  // namespace lanescape::program
