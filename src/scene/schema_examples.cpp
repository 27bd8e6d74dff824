#include "forming_sim/scene/schema.h"

namespace forming_sim {

std::string minimal_example() {
  return R"(name: stretched_strip
dimension: 2                      # plane strain
bodies:
  - name: strip
    blank:
      shape: strip
      length: 0.02                # m, along x
      thickness: 0.001            # m, along y
      cells_along: 40
      cells_through: 2
    material:
      density: 2710               # kg/m3
      youngs_modulus: 70.5e9      # Pa
      poissons_ratio: 0.34
      hardening: {curve: linear, yield_stress: 150e6, modulus: 500e6}
    boundaries:
      - {set: left, kind: fixed, axes: [x]}
      - {set: right, kind: velocity, axes: [x], times: [0, 1e-4], velocities: [[0, 0], [2, 0]], profile: smooth}
      - {set: bottom, kind: symmetric, normal: [0, 1]}
stages:
  - {kind: form, duration: 5e-4}  # s
)";
}

std::string flange_example() {
  return R"(name: flange_example
dimension: 2

bodies:
  - name: sheet
    blank:
      shape: strip
      origin: [-0.025, 0]         # its lower left corner; it lies on the die
      length: 0.040
      thickness: 0.93e-3
      cells_along: 160
      cells_through: 4
    material:
      density: 2710
      youngs_modulus: 70.5e9
      poissons_ratio: 0.34
      hardening:
        curve: voce               # 429.8 - (429.8 - 192.1) exp(-8.504 p) MPa
        yield_stress: 192.1e6
        saturation_stress: 429.8e6
        rate: 8.504
    boundaries:
      - {set: left, kind: fixed}
    sets:
      - {name: leg, choose: box, min: [0.005, -1], max: [1, 1]}

# The material of a profile lies to the left of its way.
tools:
  - name: die
    friction: 0.1348
    profile:
      start: [0, -0.03]
      pieces:
        - {to: [0, -0.001]}                    # up the side
        - {to: [-0.001, 0], radius: 0.001}     # round the edge, turning left
        - {to: [-0.03, 0]}                     # along the top
  - name: holder
    friction: 0.1348
    profile:
      start: [-0.03, 0.93e-3]
      pieces:
        - {to: [-0.002, 0.93e-3]}
        - {to: [-0.002, 0.02]}
  - name: punch
    friction: 0.1348
    profile:
      start: [0.0011, 0.03]
      pieces:
        - {to: [0.0011, 0.0035]}
        - {to: [0.0031, 0.0015], radius: 0.002}
        - {to: [0.03, 0.0015]}
    motion:
      kind: trajectory
      times: [0, 0.006]
      positions: [[0, 0], [0, -0.020]]         # from where it stands, from rest to rest

stages:
  - {name: flanging, kind: form, duration: 0.006}
  - {name: release, kind: withdraw, duration: 1e-4}  # all tools are gone, and what they held fades
  - {name: springback, kind: settle, limit: 0.02}

output:
  frames: 100
  probes:
    - {name: leg_near, body: sheet, point: [0.006, 0]}
    - {name: leg_far, body: sheet, point: [0.014, 0]}
    - {name: leg, body: sheet, set: leg}
  springback: {from: leg_near, to: leg_far}
)";
}

}  // namespace forming_sim
