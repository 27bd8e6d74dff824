#pragma once
#include "forming_sim/scene/scene.h"

namespace forming_sim {

/// A scene in 3D: a small plate, and a tool of two triangles.
inline Scene plate_scene() {
  Scene scene;
  scene.name = "plate";
  scene.dimension = 3;
  BodyConfig body;
  body.name = "plate";
  body.blank = BlankConfig{};
  body.blank->shape = "plate";
  body.blank->length = body.blank->width = 0.02;
  body.blank->thickness = 0.001;
  body.blank->cells_along = body.blank->cells_across = 4;
  body.blank->cells_through = 1;
  body.blank->pattern = "one_point";
  body.material.density = 2700;
  body.material.youngs_modulus = 70e9;
  body.material.poissons_ratio = 0.3;
  scene.bodies.push_back(body);
  ToolConfig tool;
  tool.name = "die";
  tool.mesh = MeshConfig{};
  tool.mesh->unit_scale = 0.001;
  tool.mesh->points = {{0, 0, -10}, {20, 0, -10}, {20, 20, -10}, {0, 20, -10}};
  tool.mesh->cells = {0, 1, 2, 0, 2, 3};
  tool.mesh->cell_type = "triangle";
  scene.tools.push_back(tool);
  StageConfig stage;
  stage.kind = "form";
  stage.duration = 1e-3;
  scene.stages = {stage};
  return scene;
}

}  // namespace forming_sim
