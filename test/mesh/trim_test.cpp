// Cells cut away by regions: which they are, what is left, and what is refused.
#include <gtest/gtest.h>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/generate.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/mesh/seams.h"
#include "forming_sim/mesh/trim.h"

namespace forming_sim {
namespace {

Mesh plate(const std::string& pattern = "fine") {
  BlankConfig blank;
  blank.shape = "plate";
  blank.length = 4, blank.width = 3, blank.thickness = 1;
  blank.cells_along = 8, blank.cells_across = 6, blank.cells_through = 2;
  blank.pattern = pattern;
  return generate_blank(blank);
}
Mesh strip() {
  BlankConfig blank;
  blank.shape = "strip";
  blank.length = 4, blank.thickness = 1;
  blank.cells_along = 8, blank.cells_through = 2;
  return generate_blank(blank);
}

TrimConfig plane(const Vec3& point, const Vec3& normal) {
  TrimConfig cut;
  cut.choose = "plane";
  cut.point = point, cut.normal = normal;
  return cut;
}
TrimConfig box(const Vec3& min, const Vec3& max, bool outside = false) {
  TrimConfig cut;
  cut.choose = "box";
  cut.min = min, cut.max = max, cut.outside = outside;
  return cut;
}
TrimConfig round(const char* choose, const Vec3& point, double radius, bool outside = false) {
  TrimConfig cut;
  cut.choose = choose;
  cut.point = point, cut.radius = radius, cut.outside = outside;
  return cut;
}

Mesh cut(const Mesh& mesh, const std::vector<TrimConfig>& regions) {
  Mesh rest = remaining(mesh, find_remainder(mesh, regions));
  check_volumes(rest);
  return rest;
}
double area_of(const Mesh& mesh) {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (const Facet& f : mesh.surface) sum += area_vector(mesh, f), area += area_vector(mesh, f).norm();
  EXPECT_LT(sum.norm(), 1e-12) << "the surface is closed";
  return area;
}
std::string refusal(const Mesh& mesh, const std::vector<TrimConfig>& regions) {
  try {
    find_remainder(mesh, regions);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::mesh_error);
    return error.what();
  }
  return "";
}

TEST(Trim, CutsAwayWhereTheNormalOfAPlanePoints) {
  for (const char* pattern : {"fine", "coarse", "one_point"}) {
    const Mesh rest = cut(plate(pattern), {plane(Vec3(1, 0, 0), Vec3(2, 0, 0))});
    EXPECT_NEAR(volume(rest), 3, 1e-12);
    EXPECT_NEAR(bounds(rest).max().x(), 1, 1e-12);
    EXPECT_NEAR(area_of(rest), 2 * (3 + 1 + 3), 1e-12);
  }
}

TEST(Trim, CutsAwayWhatIsInsideOrOutside) {
  EXPECT_NEAR(volume(cut(plate(), {box(Vec3(1, 1, 0), Vec3(2, 2, 1))})), 11, 1e-12);
  EXPECT_NEAR(volume(cut(plate(), {box(Vec3(1, 1, 0), Vec3(2, 2, 1), true)})), 1, 1e-12);
  EXPECT_NEAR(volume(cut(plate(), {box(Vec3(1, 1, 0), Vec3(2, 2, .5)), plane(Vec3(0, 2.5, 0), Vec3(0, 1, 0))})), 9.5, 1e-12);
  // by the middles of cells of half a unit: those at +-.25 and +-.25 of (1.5, 1.5)
  EXPECT_NEAR(volume(cut(plate(), {round("cylinder", Vec3(1.5, 1.5, 0), .4)})), 11, 1e-12);
  EXPECT_NEAR(volume(cut(plate(), {round("cylinder", Vec3(1.5, 1.5, 0), .4, true)})), 1, 1e-12);
  EXPECT_NEAR(volume(cut(plate(), {round("sphere", Vec3(1.5, 1.5, 0), .5)})), 11.5, 1e-12);
  TrimConfig along = round("cylinder", Vec3(0, 1.5, .5), .4);
  along.axis = Vec3(1, 0, 0);
  EXPECT_NEAR(volume(cut(plate(), {along})), 8, 1e-12);
}

TEST(Trim, CutsSectionsWhateverTheirZ) {
  EXPECT_NEAR(volume(cut(strip(), {box(Vec3(1, 0, 5), Vec3(2, 1, 5))})), 3, 1e-12);
  EXPECT_NEAR(volume(cut(strip(), {round("cylinder", Vec3(1, .5, 0), .4)})), 3, 1e-12);
  EXPECT_NEAR(volume(cut(strip(), {plane(Vec3(1, 0, 0), Vec3(1, 0, 3))})), 1, 1e-12);
}

TEST(Trim, SetsKeepWhatIsLeftOfThem) {
  const Mesh mesh = plate(), rest = cut(mesh, {plane(Vec3(1, 0, 0), Vec3(1, 0, 0))});
  EXPECT_EQ(rest.sets.count("right"), 0u) << "nothing is left of it";
  ASSERT_EQ(rest.sets.count("left"), 1u);
  EXPECT_EQ(rest.sets.at("left").size(), mesh.sets.at("left").size());
  for (int n : rest.sets.at("top")) EXPECT_NEAR(rest.nodes[n].z(), 1, 1e-12);
  EXPECT_LT(rest.sets.at("top").size(), mesh.sets.at("top").size());
}

TEST(Trim, CountsThePieces) {
  EXPECT_EQ(count_parts(plate()), 1);
  EXPECT_EQ(count_parts(cut(plate(), {box(Vec3(1, -1, -1), Vec3(2, 9, 9))})), 2);
  EXPECT_EQ(count_parts(cut(strip(), {box(Vec3(1, -1, 0), Vec3(1.5, 9, 0)), box(Vec3(3, -1, 0), Vec3(3.5, 9, 0))})), 3);
}

TEST(Trim, SaysWhatIsWrong) {
  EXPECT_NE(refusal(plate(), {plane(Vec3(9, 0, 0), Vec3(1, 0, 0))}).find("trim[0]: given 'plane'; no cell lies there: the body extends from (0, 0, 0) m to (4, 3, 1) m"), std::string::npos);
  EXPECT_NE(refusal(plate(), {plane(Vec3(1, 0, 0), Vec3(1, 0, 0)), box(Vec3(9, 9, 9), Vec3(10, 10, 10))}).find("trim[1]: given 'box'; no cell"), std::string::npos);
  const std::string both = refusal(plate(), {box(Vec3(9, 9, 9), Vec3(10, 10, 10)), plane(Vec3(9, 0, 0), Vec3(1, 0, 0))});
  EXPECT_NE(both.find("trim[0]"), std::string::npos) << both;
  EXPECT_NE(both.find("trim[1]"), std::string::npos) << both;
  EXPECT_NE(refusal(plate(), {plane(Vec3(-1, 0, 0), Vec3(1, 0, 0))}).find("nothing is left"), std::string::npos);
  EXPECT_NE(refusal(plate(), {box(Vec3(1, 1, 1), Vec3(0, 2, 2))}).find("exchange the coordinates"), std::string::npos);
  EXPECT_NE(refusal(strip(), {plane(Vec3(0, 0, 0), Vec3(0, 0, 1))}).find("has no length in x and y"), std::string::npos);
}

}  // namespace
}  // namespace forming_sim
