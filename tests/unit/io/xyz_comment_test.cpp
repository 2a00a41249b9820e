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
    EXPECT_NO_THROW(check_periodic(required(comment.periodic, ""))) << pbc;
    EXPECT_EQ(comment.info.size(), 1u) << pbc;
  }
}

}  // namespace
}  // namespace lanescape::xyz
