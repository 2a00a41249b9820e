#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "every_isa.hpp"
#include "verification/neighbour_checks.hpp"
#include "wrong_kernels.hpp"

namespace lanescape {
namespace {

using kernels::KernelTable;

const std::vector<PairCase>& every_case() {
  static const std::vector<PairCase> cases = pair_cases();
  return cases;
}

using NeighbourParity = testing::EveryIsa;

INSTANTIATE_TEST_SUITE_P(EveryIsa, NeighbourParity, testing::all_isas(), testing::isa_name);

TEST_P(NeighbourParity, PairsAreThoseOfTheReferenceOnEveryCase) {
  for (const Deviation& deviation : verify_neighbour_pairs(kernel_table(GetParam()), every_case())) {
    EXPECT_TRUE(deviation.passed()) << describe(deviation);
    EXPECT_GT(deviation.cases, 20u);
  }
}

const KernelTable* right = nullptr;

std::size_t group_without_its_last_point(const kernels::PointGrid& grid, const kernels::GroupQuery& query,
                                         const kernels::GroupOutput& out) noexcept {
  const std::size_t found = right->points_within_group(grid, query, out);
  std::uint32_t& last = out.counts[query.row_count - 1];
  if (found > out.capacity || last == 0) return found;
  --last;
  return found - 1;
}

std::size_t group_with_its_own_points(const kernels::PointGrid& grid, const kernels::GroupQuery& query,
                                      const kernels::GroupOutput& out) noexcept {
  std::vector<kernels::GroupRow> rows(query.rows, query.rows + query.row_count);
  for (kernels::GroupRow& row : rows) row.self = 0xffffffff;
  kernels::GroupQuery without = query;
  without.rows = rows.data();
  return right->points_within_group(grid, without, out);
}

std::size_t list_without_its_last_point(const kernels::GroupRow* rows, std::size_t row_count, const kernels::NearPoints* near,
                                        std::size_t species_count, std::uint32_t* neighbours, std::uint32_t* lengths) noexcept {
  const std::size_t size = right->list_group(rows, row_count, near, species_count, neighbours, lengths);
  if (std::uint32_t& last = lengths[row_count * species_count - 1]; last % kernels::slot_padding > 1) --last;
  return size;
}

std::size_t columns_but_for_the_last(const kernels::PointGrid& grid, const double* low, const double* high, double reach,
                                     kernels::NearColumns& columns) noexcept {
  const std::size_t found = right->columns_near_rectangle(grid, low, high, reach, columns);
  if (found > 1 && found <= columns.capacity) --columns.count;  // a search without its own column is not foreseen
  return found;
}

std::size_t points_with_one_out_of_reach(const kernels::PointGrid& grid, const kernels::NearColumns& columns,
                                         const kernels::GroupRow* rows, std::size_t row_count, const std::uint32_t* numbers,
                                         kernels::NearPoints& near) noexcept {
  const std::size_t found = right->points_near_group(grid, columns, rows, row_count, numbers, near);
  if (found > 0 && found <= near.capacity) near.z[found / 2] = 1e30F;
  return found;
}

void left_as_it_is(const std::uint32_t* numbers, std::size_t n, std::uint32_t* sorted) noexcept { std::copy_n(numbers, n, sorted); }

TEST(NeighbourChecks, FailForTheKernelThatIsWrong) {
  right = &kernel_table(available_isas().back());
  const auto failed_with = [](auto KernelTable::* kernel, auto replacement) {
    return testing::failed_of(verify_neighbour_pairs(testing::with_kernel(*right, kernel, +replacement), every_case()));
  };
  using Names = std::vector<std::string>;
  const Names both = {"points_within_group: pairs", "sort_few: sorted pairs"};
  EXPECT_EQ(testing::failed_of(verify_neighbour_pairs(*right, every_case())), Names{});
  EXPECT_EQ(failed_with(&KernelTable::points_within_group, group_without_its_last_point), both);
  EXPECT_EQ(failed_with(&KernelTable::points_within_group, group_with_its_own_points), both);
  const Names lists = {"list_group: lists"};
  EXPECT_EQ(failed_with(&KernelTable::list_group, list_without_its_last_point), lists);
  EXPECT_EQ(failed_with(&KernelTable::columns_near_rectangle, columns_but_for_the_last), lists);
  EXPECT_EQ(failed_with(&KernelTable::points_near_group, points_with_one_out_of_reach), lists);
  EXPECT_EQ(failed_with(&KernelTable::sort_few, left_as_it_is), Names{both[1]});
}

}  // namespace
}  // namespace lanescape
