#include "run/flow_record.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "run/flow_run.hpp"

namespace lanescape {
namespace {

constexpr std::size_t numbers_of_insertion = 6, numbers_of_slice = 8;
constexpr std::size_t blocks_of_means = 10;

void append(std::vector<double>& record, std::initializer_list<double> numbers) {
  record.insert(record.end(), numbers.begin(), numbers.end());
}

void append(std::vector<double>& record, const FlowBalance::Content& content) {
  append(record, {content.particles, content.energy, content.momentum[0], content.momentum[1], content.momentum[2]});
}

// Takes numbers out of a record, one after the other.
class Reader {
 public:
  explicit Reader(const double* next) : next_(next) {}
  double number() { return *next_++; }
  std::uint64_t count() { return static_cast<std::uint64_t>(number()); }
  Point point() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
  FlowBalance::Content content() {
    const double particles = number(), energy = number();
    return {particles, energy, point()};
  }

 private:
  const double* next_;
};

constexpr std::size_t numbers_of_row = 1 + 3 * 5 + 2 * 3 + 4;

FlowRow row_of(Reader numbers, const std::vector<double>& x) {
  FlowRow row;
  row.time = numbers.number();
  row.balance.start = numbers.content();
  row.balance.now = numbers.content();
  row.balance.passed = numbers.content();
  for (FaceExchange::Counts& counts : row.balance.faces)
    for (std::uint64_t* count : {&counts.left, &counts.put_in, &counts.taken_out}) *count = numbers.count();
  for (double& pressure : row.pressure) pressure = numbers.number();
  for (double& flux : row.momentum_flux) flux = numbers.number();
  row.profile.x = x;
  for (std::size_t slice = 0; slice < x.size(); ++slice) {
    row.profile.density.push_back(numbers.number());
    row.profile.velocity.push_back(numbers.point());
    row.profile.temperature.push_back(numbers.number());
    row.profile.energy.push_back(numbers.number());
    row.profile.mass_flux.push_back(numbers.number());
    row.profile.pressure.push_back(numbers.number());
  }
  return row;
}

}  // namespace

void FlowRecord::add_insertions(const OpenSlab& slab, double time) {
  for (std::size_t face = 0; face < 2; ++face)
    for (const FlowInsertion& one : slab.insertions(face))
      append(insertions_, {static_cast<double>(face), one.time + (time - slab.time()), one.density,
                           static_cast<double>(one.evaluations), one.energy, one.distance});
}

void FlowRecord::add_row(OpenSlab& slab, const Outside& outside, double time) {
  const FlowProfile means = slab.sampler().profile();
  slab.sampler().clear();
  x_ = means.x;
  rows_.push_back(time);
  append(rows_, slab.balance().start);
  append(rows_, slab.balance().now);
  append(rows_, slab.balance().passed);
  for (const FaceExchange::Counts& counts : slab.balance().faces)
    for (const std::uint64_t count : {counts.left, counts.put_in, counts.taken_out}) rows_.push_back(static_cast<double>(count));
  append(rows_, {slab.demands()[0].pressure, slab.demands()[1].pressure});
  for (const FaceReport& report : slab.reports())
    rows_.push_back(report.momentum[0] / (slab.geometry().area * slab.coupling_time()));
  for (std::size_t k = 0; k < x_.size(); ++k)
    append(rows_, {means.density[k], means.velocity[k][0], means.velocity[k][1], means.velocity[k][2], means.temperature[k],
                   means.energy[k], means.mass_flux[k], means.pressure[k]});
  const std::vector<OutsideCell> cells = outside.cells();
  outside_.push_back(static_cast<double>(cells.size()));
  for (const OutsideCell& cell : cells) append(outside_, {cell.x, cell.density, cell.velocity, cell.temperature});
}

void FlowRecord::put_into(FlowResult& result) const {
  const std::size_t numbers = numbers_of_row + numbers_of_slice * x_.size();
  for (std::size_t k = 0; k + numbers <= rows_.size(); k += numbers) result.rows.push_back(row_of(Reader(rows_.data() + k), x_));
  Reader outside(outside_.data());
  for (FlowRow& row : result.rows)
    for (std::uint64_t left = outside.count(); left > 0; --left) {
      const double x = outside.number(), density = outside.number(), velocity = outside.number();
      row.outside.push_back({x, density, velocity, outside.number()});
    }
  for (std::size_t k = 0; k < insertions_.size(); k += numbers_of_insertion) {
    const double* one = insertions_.data() + k;
    result.insertions[static_cast<std::size_t>(one[0])].push_back(
        {one[1], one[2], static_cast<std::uint64_t>(one[3]), one[4], one[5]});
  }
}

void FlowRecord::exchange(Archive& archive) {
  archive.enter("record");
  archive.field("x", x_);
  archive.field("rows", rows_);
  archive.field("outside", outside_);
  archive.field("insertions", insertions_);
  archive.leave();
}

namespace {

// Mean and slope of values over the slices of a row.
struct Line {
  double mean = 0.0, slope = 0.0;
};

Line line_through(const std::vector<double>& x, const std::vector<double>& y, double low, double high) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k] < low || x[k] > high) continue;
    n += 1.0;
    sx += x[k];
    sy += y[k];
    sxx += x[k] * x[k];
    sxy += x[k] * y[k];
  }
  const double spread = sxx - sx * sx / n;
  return {sy / n, spread > 0.0 ? (sxy - sx * sy / n) / spread : 0.0};
}

FlowMean mean_of(const std::vector<Line>& lines) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (lines.empty()) return {{none, {}}, {none, {}}};
  std::vector<double> means, slopes;
  const std::size_t blocks = std::min(blocks_of_means, lines.size());
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t begin = lines.size() * b / blocks, end = lines.size() * (b + 1) / blocks;
    Line sum;
    for (std::size_t k = begin; k < end; ++k) {
      sum.mean += lines[k].mean;
      sum.slope += lines[k].slope;
    }
    means.push_back(sum.mean / static_cast<double>(end - begin));
    slopes.push_back(sum.slope / static_cast<double>(end - begin));
  }
  return {estimate_mean(means), estimate_mean(slopes)};
}

}  // namespace

void put_means(FlowResult& result, double from, double low, double high) {
  std::vector<Line> density, velocity, temperature;
  for (const FlowRow& row : result.rows) {
    if (row.time <= from) continue;
    std::vector<double> along_x;
    for (const Point& v : row.profile.velocity) along_x.push_back(v[0]);
    density.push_back(line_through(row.profile.x, row.profile.density, low, high));
    velocity.push_back(line_through(row.profile.x, along_x, low, high));
    temperature.push_back(line_through(row.profile.x, row.profile.temperature, low, high));
  }
  result.density = mean_of(density);
  result.velocity = mean_of(velocity);
  result.temperature = mean_of(temperature);
}

}  // namespace lanescape
