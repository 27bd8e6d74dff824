// Scenes that are taken, and told because more often they are a slip than meant.
#include <algorithm>
#include <cmath>

#include "forming_sim/mesh/measure.h"
#include "forming_sim/scene/build.h"
#include "forming_sim/scene/validate.h"
#include "scene/plate_scene.h"
#include "scene/scene_texts.h"
#include "support/free_mesh.h"

namespace forming_sim {
namespace {

TEST(OddScene, FlatCellsOfTetrahedraAreTold) {
  Scene scene = plate_scene();  // cells of 5 x 5 x 1 mm
  scene.tools.clear();
  for (const char* pattern : {"fine", "coarse", "one_point"}) {
    scene.bodies[0].blank->pattern = pattern;
    const std::vector<std::string> notes = build_model(scene).notes;
    ASSERT_EQ(notes.size(), pattern == std::string("one_point") ? 0u : 1u) << pattern;
    for (const std::string& note : notes) EXPECT_NE(note.find("body plate are 5 times as long and as wide as they are thick"), std::string::npos) << note;
  }
  scene.bodies[0].blank->pattern = "fine";
  scene.bodies[0].blank->cells_along = 20;  // as thick as long: it bends along x
  EXPECT_TRUE(build_model(scene).notes.empty());
}

TEST(OddScene, SheetsWithOneFreeTetrahedronThroughTheirThicknessAreTold) {
  Scene scene = plate_scene();
  scene.tools.clear();
  scene.bodies[0].blank.reset();
  const auto told = [&](const Vec3& size, double edge) {
    scene.bodies[0].mesh = inline_mesh(free_box(size, edge));
    const std::vector<std::string> notes = build_model(scene).notes;
    return std::any_of(notes.begin(), notes.end(), [](const std::string& note) { return note.find("the tetrahedra of body plate have edges") != std::string::npos; });
  };
  EXPECT_TRUE(told(Vec3(12e-3, 6e-3, 1e-3), 1e-3));
  EXPECT_FALSE(told(Vec3(12e-3, 6e-3, 1e-3), 0.5e-3));
  EXPECT_FALSE(told(Vec3(12e-3, 1e-3, 1e-3), 0.5e-3)) << "a bar";
  EXPECT_FALSE(told(Vec3(3e-3, 3e-3, 3e-3), 2e-3)) << "a block";
}

// A polygon of n sides with its corners on the circle has less area by 1 - n sin(2 pi/n)/(2 pi): 2.6 % at 16.
TEST(OddScene, PolygonalBarsAreTold) {
  Scene scene = plate_scene();
  scene.tools.clear();
  BlankConfig& blank = *scene.bodies[0].blank;
  blank.shape = "bar";
  blank.radius = 3e-3, blank.length = 0.02;
  blank.cells_along = 4;
  const auto told = [&](int cells, const char* portion) {
    blank.cells_radius = cells, blank.portion = portion;
    const std::vector<std::string> notes = build_model(scene).notes;
    for (const std::string& note : notes)
      if (note.find("is a polygon") != std::string::npos) return note;
    return std::string();
  };
  for (const char* portion : {"full", "half", "quarter"}) {
    EXPECT_NE(told(4, portion).find("has 2.55 % less area"), std::string::npos) << told(4, portion);
    EXPECT_EQ(told(8, portion), "") << portion;
  }
}

// Crossed triangles are too soft where a sheet's cells are higher than long, and about the axis.
TEST(OddScene, SoftStripsAreTold) {
  Scene scene = plate_scene();
  scene.tools.clear();
  scene.dimension = 2;
  BlankConfig& blank = *scene.bodies[0].blank;
  blank.shape = "strip";
  blank.length = 0.02, blank.thickness = 0.001;
  const auto notes = [&](int along, int through, const char* pattern, bool axisymmetric, double x) {
    blank.cells_along = along, blank.cells_through = through, blank.pattern = pattern;
    blank.origin = Vec3(x, 0, 0);
    scene.axisymmetric = axisymmetric;
    std::vector<std::string> all = build_model(scene).notes;
    all.erase(std::remove_if(all.begin(), all.end(), [](const std::string& note) { return note.find("in bending") == std::string::npos; }), all.end());
    return all;
  };
  EXPECT_TRUE(notes(20, 1, "fine", false, 0).empty());
  ASSERT_EQ(notes(80, 2, "fine", false, 0).size(), 1u);
  EXPECT_NE(notes(80, 2, "fine", false, 0)[0].find("2 times as high as they are long: it lacks some 13 % of its stiffness in bending"), std::string::npos) << notes(80, 2, "fine", false, 0)[0];
  EXPECT_TRUE(notes(80, 2, "one_point", false, 0).empty());
  EXPECT_TRUE(notes(320, 4, "fine", false, 0).empty());  // 3 %
  ASSERT_EQ(notes(40, 2, "fine", true, 0).size(), 1u);
  EXPECT_NE(notes(40, 2, "fine", true, 0)[0].find("reaches the axis"), std::string::npos);
  EXPECT_TRUE(notes(40, 2, "fine", true, 0.02).empty());
}

// Values that are taken but look like wrong units, and what lies behind the end of the stages.
TEST(OddScene, OddValuesAreTold) {
  const auto notes_of = [](auto&& change) {
    Scene scene = plate_scene();
    scene.bodies[0].blank->pattern = "one_point";
    HardeningConfig hardening;
    hardening.curve = "perfect";
    hardening.yield_stress = 2e8;
    scene.bodies[0].material.hardening = hardening;
    change(scene);
    std::vector<std::string> all = build_model(scene).notes;
    all.erase(std::remove_if(all.begin(), all.end(), [](const std::string& note) { return note.find("the surface is open") != std::string::npos; }), all.end());
    return all;
  };
  EXPECT_TRUE(notes_of([](Scene&) {}).empty());
  const auto told = [&](const std::string& text, auto&& change) {
    const std::vector<std::string> notes = notes_of(change);
    ASSERT_EQ(notes.size(), 1u) << text;
    EXPECT_NE(notes[0].find(text), std::string::npos) << notes[0];
  };
  told("the density of body plate is 7.85 kg/m3: steel has 7850", [](Scene& s) { s.bodies[0].material.density = 7.85; });
  told("the yield stress of body plate is 200 Pa", [](Scene& s) { s.bodies[0].material.hardening->yield_stress = 200; });
  told("the yield stress of body plate is 2e+10 Pa", [](Scene& s) { s.bodies[0].material.hardening->yield_stress = 2e10; });
  told("body plate begins with 10000 m/s, where waves in it have", [](Scene& s) { s.bodies[0].initial_velocity = Vec3(0, 0, 1e4); });
  told("friction of tool die is 9: metals in forming", [](Scene& s) { s.tools[0].friction = 9; });
  told("friction of bodies against each other is 1.5", [](Scene& s) { s.contact.friction = 1.5; });
  told("Young's modulus of body plate is 70500 Pa: metals have", [](Scene& s) {
    s.bodies[0].material.youngs_modulus = 70500;
    s.bodies[0].material.hardening->yield_stress = 150;
  });
  told("the hardening modulus of body plate is 1e+14 Pa, not below Young's modulus", [](Scene& s) {
    s.bodies[0].material.hardening->curve = "linear";
    s.bodies[0].material.hardening->modulus = 1e14;
  });
  told("time_step.mass_scaling 1000000 makes waves 1000 times as slow", [](Scene& s) { s.time_step.mass_scaling = 1e6; });
  told("output.interval is 50 s and the stages end at", [](Scene& s) { s.output.interval = 50; });
  told("probe tip is put 100 m outside body plate", [](Scene& s) {
    ProbeConfig probe;
    probe.name = "tip";
    probe.point = Vec3(100, 0, 0);
    s.output.probes.push_back(probe);
  });
  told("goes on to 1000 s and the stages end at", [](Scene& s) {
    MotionConfig motion;
    motion.kind = "velocity";
    motion.times = {0, 1000};
    motion.velocities = {Vec3::Zero(), Vec3::UnitZ()};
    s.tools[0].motion = motion;
  });
  const auto by_places = [](Scene& s, int knots) -> MotionConfig& {
    s.tools[0].motion.emplace();
    MotionConfig& motion = *s.tools[0].motion;
    motion.kind = "trajectory";
    for (int k = 0; k < knots; ++k) motion.times.push_back(1e-5 * k);
    return motion;
  };
  told("[0, 0, 179] to [0, 0, -179] degrees, by 358, from knot 1 to the next: rotations_deg count on beyond 180", [&](Scene& s) {
    by_places(s, 3).rotations_deg = {Vec3(0, 0, 160), Vec3(0, 0, 179), Vec3(0, 0, -179)};
    s.tools[0].position = s.tools[0].motion->centre = Vec3(0, 0, 1);
  });
  const auto on_a_path = [&](const char* profile) {
    return [&by_places, profile](Scene& s) {
      MotionConfig& motion = by_places(s, 30);
      motion.profile = profile;
      for (int k = 0; k < 30; ++k) motion.positions.emplace_back(1e-5 * k, 0, 0);
    };
  };
  told("stops at each of 28 knots on its way, since profile is smooth", on_a_path("smooth"));
  EXPECT_TRUE(notes_of(on_a_path("spline")).empty());
  told("tool " + plate_scene().tools[0].name + " moves with 2000 m/s, where waves in the bodies have", [](Scene& s) {
    MotionConfig motion;
    motion.kind = "trajectory";
    motion.times = {0, 1e-5};
    motion.positions = {Vec3::Zero(), Vec3(0, 0, 0.02)};
    s.tools[0].motion = motion;
  });
  const auto roll = [](const Vec3& centre) {
    return [centre](Scene& s) {
      MotionConfig motion;
      motion.kind = "velocity";
      motion.times = {0};
      motion.spins_deg_s = {Vec3(0, 100, 0)};
      motion.centre = centre;
      s.tools[0].position += Vec3(0, 0, -1e-3);
      s.tools[0].motion = motion;
    };
  };
  told("tool " + plate_scene().tools[0].name + " turns about [0, 0, 0], since motion.centre is not given", roll(Vec3::Zero()));
  EXPECT_TRUE(notes_of(roll(Vec3(0, 0, -1e-3))).empty());
  told("turns about [0, 0, -0.001], and its position, [0, 0, 0], goes round with it", [&](Scene& s) {
    roll(Vec3(0, 0, -1e-3))(s);
    s.tools[0].position = Vec3::Zero();
  });
  EXPECT_TRUE(notes_of([](Scene& s) {  // a friction factor alone
    s.tools[0].friction = s.contact.friction = 10;
    s.tools[0].friction_limit = s.contact.friction_limit = 50e6;
  }).empty());
  const auto driven = [](double speed, double until) {
    BoundaryConfig drive;
    drive.set = "left";
    drive.kind = "velocity";
    drive.times = {0, until};
    drive.velocities = {Vec3::Zero(), Vec3(speed, 0, 0)};
    return drive;
  };
  told("set left of body plate is driven with 2000 m/s", [&](Scene& s) { s.bodies[0].boundaries.push_back(driven(2000, 1e-6)); });
  const double end = plate_scene().stages.back().duration;
  const auto after = [&](double until) {
    return [&, until](Scene& s) {
      s.stages.push_back(s.stages.back());
      s.stages.back().name = "later";
      s.bodies[0].boundaries.push_back(driven(1, until));
      s.bodies[0].boundaries.back().since = "later";
    };
  };
  told("the motion of set left of body plate goes on to", after(1.01 * end));
  EXPECT_TRUE(notes_of(after(0.99 * end)).empty());
  told("the motion of set left of body plate goes on to 1000 s", [&](Scene& s) { s.bodies[0].boundaries.push_back(driven(1, 1000)); });
  told("the pressure on set top of body plate goes on to 1000 s", [](Scene& s) {
    PressureConfig pressure;
    pressure.set = "top";
    pressure.times = {0, 1000};
    pressure.values = {0, 1e6};
    s.bodies[0].pressures.push_back(pressure);
  });
  EXPECT_TRUE(notes_of([](Scene& s) {  // level: nothing is missed
    PressureConfig pressure;
    pressure.set = "top";
    pressure.times = {0, 1000};
    pressure.values = {1e6, 1e6};
    s.bodies[0].pressures.push_back(pressure);
  }).empty());
}

// A body that measures 20 m is more often one in millimetres.
TEST(OddScene, ABodyOfManyMetresIsTold) {
  Scene scene = plate_scene();
  scene.tools.clear();
  scene.bodies[0].blank.reset();
  MeshConfig mesh;
  mesh.unit_scale = 1;
  mesh.cell_type = "tetrahedron";
  mesh.points = {Vec3(0, 0, 0), Vec3(20, 0, 0), Vec3(0, 20, 0), Vec3(0, 0, 20)};
  mesh.cells = {0, 1, 2, 3};
  scene.bodies[0].mesh = mesh;
  const auto tells = [&] {
    const std::vector<std::string> notes = build_model(scene).notes;
    return std::any_of(notes.begin(), notes.end(), [](const std::string& note) { return note.find("measures 20 m: with unit_scale 0.001 it would be 0.02 m") != std::string::npos; });
  };
  EXPECT_TRUE(tells());
  scene.bodies[0].mesh->unit_scale = 0.1;
  EXPECT_FALSE(tells());
}

// What a body without self contact does where it has more parts than one is told.
TEST(OddScene, ABodyInTwoPartsIsTold) {
  Scene scene = plate_scene();
  scene.tools.clear();
  scene.bodies[0].blank.reset();
  MeshConfig mesh;
  mesh.unit_scale = 1e-2;
  mesh.cell_type = "tetrahedron";
  for (double x : {0.0, 2.0})
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) mesh.points.push_back(p + x * Vec3::UnitX());
  mesh.cells = {0, 1, 2, 3, 4, 5, 6, 7};
  scene.bodies[0].mesh = mesh;
  const std::vector<std::string> notes = build_model(scene).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("body plate consists of 2 parts that share no node"), std::string::npos) << notes[0];
  scene.bodies[0].self_contact = true;
  EXPECT_TRUE(build_model(scene).notes.empty());
  scene.bodies[0].self_contact = false;
  scene.bodies[0].mesh->cells = {0, 1, 2, 3};
  scene.bodies[0].mesh->points.resize(4);
  EXPECT_TRUE(build_model(scene).notes.empty());
}

// A length in millimetres, and a wall that stands.
TEST(OddScene, StripsOfOddShapesAreTold) {
  const auto told = [](double length, double thickness, bool about_axis = false) {
    Scene scene = plate_scene();
    scene.tools.clear();
    scene.dimension = 2;
    scene.axisymmetric = about_axis;
    BlankConfig& blank = *scene.bodies[0].blank;
    blank.shape = "strip";
    blank.length = length, blank.thickness = thickness;
    blank.cells_along = 40, blank.cells_through = 2;
    const std::vector<std::string> notes = build_model(scene).notes;
    return notes.empty() ? "" : notes[0];
  };
  EXPECT_EQ(told(.04, .001), "");
  EXPECT_NE(told(9, .001).find("cells of body plate are 450 times as long as they are high: its length is 9 m"), std::string::npos) << told(9, .001);
  EXPECT_NE(told(.001, .06).find("is a strip 60 times as thick as it is long: thickness and thinning"), std::string::npos) << told(.001, .06);
  EXPECT_EQ(told(.001, .06, true), "") << "a solid bar";
}

TEST(OddScene, SpringbackNeedsTwoNodes) {
  Scene scene = plate_scene();
  ProbeConfig near, far;
  near.name = "near", far.name = "far";
  near.point = Vec3(.005, 0, 0), far.point = Vec3(.0055, 0, 0);
  scene.output.probes = {near, far};
  scene.output.springback = SpringbackConfig{"near", "far", "", ""};
  const std::vector<Fault> faults = validate(scene);
  ASSERT_EQ(faults.size(), 1u) << sentences(faults);
  EXPECT_EQ(faults[0].field, "output.springback.to");
  EXPECT_NE(faults[0].sentence().find("at (0.005, 0, 0) m is the nearest to this probe and to near"), std::string::npos) << faults[0].sentence();
  scene.output.probes[1].point = Vec3(.01, 0, 0);
  EXPECT_TRUE(validate(scene).empty());
}

}  // namespace
}  // namespace forming_sim
