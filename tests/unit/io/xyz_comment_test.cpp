#include "io/xyz_comment.hpp"

#include <gtest/gtest.h>

namespace lanescape::xyz {
namespace {

TEST(XyzComment, TheBoxMayBeWrittenWithCommasAndBrackets) {
  for (const char* lattice : {"[4, 0, 0, 0, 5, 0, 0, 0, 6]", "\"4, 0, 0, 0, 5, 0, 0, 0, 6\"", "[4,0,0,0,5,0,0,0,6]",
                              "{4 0 0 0 5 0 0 0 6}", "'4 0 0 0 5 0 0 0 6'", "[[4, 0, 0], [0, 5, 0], [0, 0, 6]]",
                              "[[4,0,0],[0,5,0],[0,0,6]]", "[4, 5, 6]", "\"4 5 6\"", "\"4d0 0 0 0 .5D+1 0 0 0 0.6E1\""}) {
    const Comment comment = parse_comment(std::string("Lattice=") + lattice + " step=3");
    EXPECT_EQ(parse_lattice(required(comment.lattice, "")), (Box{{4.0, 5.0, 6.0}})) << lattice;
    EXPECT_EQ(comment.info.size(), 1u) << lattice;
  }
}

TEST(XyzComment, PeriodicAxesMayBeWrittenAsOthersDo) {
  for (const char* pbc : {"\"T T T\"", "[T, T, T]", "[T,T,T]", "\"T, T, T\"", "[true, true, true]", "[True, True, True]", "T",
                          "TRUE", "[TRUE, T, true]", "\"1 1 1\"", "[1, 1, 1]", "1", "{T T T}"}) {
    const Comment comment = parse_comment(std::string("step=3 pbc=") + pbc);
    EXPECT_EQ(parse_periodic(required(comment.periodic, "")), (std::array{true, true, true})) << pbc;
    EXPECT_EQ(comment.info.size(), 1u) << pbc;
  }
  for (const char* pbc :
       {"\"F T T\"", "[F, T, T]", "\"f, t, t\"", "[False, True, True]", "[false, T, 1]", "\"0 1 1\"", "[0, 1, 1]"})
    EXPECT_EQ(parse_periodic(*parse_comment(std::string("pbc=") + pbc).periodic), (std::array{false, true, true})) << pbc;
  for (const char* pbc : {"F", "0", "false", "\"F F F\""})
    EXPECT_EQ(parse_periodic(*parse_comment(std::string("pbc=") + pbc).periodic), (std::array{false, false, false})) << pbc;
  for (const char* pbc : {"\"\"", "\"F T\"", "\"F T T T\"", "yes", "\"F 2 T\"", "-1"})
    EXPECT_THROW(parse_periodic(*parse_comment(std::string("pbc=") + pbc).periodic), Refusal) << pbc;
}

}  // namespace
}  // namespace lanescape::xyz
