// A million steps of a vibrating cell, of a spinning body and of a clamped strip, by the
// classical method, the law as printed and the law of the package.
#include <functional>

#include "paper/figures.h"
#include "paper/single_cell.h"

namespace forming_sim::bench {
namespace {

constexpr long kSteps = 1000000;
constexpr int kLooks = 50;

struct Case {
  const char* name;
  double part_of_step;  ///< dt over the stable step
  bool clamped;
  Mesh mesh;
  /// Velocities at the start, v^(-1/2).
  std::function<void(SteppedBody&, double dt)> start;
};

struct Look {
  double time, volume, angle, energy, momentum;
};

double turned(const SteppedBody& body) {
  // The mean rotation about z: of all nodes from where they started.
  double sine = 0, cosine = 0;
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    const Node &a = body.X[i], &b = body.x[i];
    sine += body.mass()[i] * (a[0] * b[1] - a[1] * b[0]);
    cosine += body.mass()[i] * (a[0] * b[0] + a[1] * b[1]);
  }
  return std::atan2(sine, cosine);
}

std::vector<Look> run(const Case& what, const std::string& law) {
  SteppedBody body(what.mesh, cell_material(law));
  const double dt = what.part_of_step * body.stable_step();
  what.start(body, dt);
  std::vector<Look> looks;
  double angle = 0, before = 0;
  const long every = kSteps / (20 * kLooks);
  Look mean{};
  for (long n = 0; n < kSteps; ++n) {
    body.accelerate(dt);
    if (n % every == 0) {  // 20 glances a look, at times that no vibration keeps
      const double now = turned(body);
      angle += std::remainder(now - before, 2 * M_PI);
      before = now;
      mean.volume += body.volume_ratio() / 20;
      mean.energy += body.energy() / 20;
      mean.momentum += body.angular_momentum().z() / 20;
      mean.time += static_cast<double>(n) * dt / 20;
      mean.angle = angle;
      if (n / every % 20 == 19) {
        looks.push_back(mean);
        mean = {};
      }
    }
    body.move(dt);
  }
  return looks;
}

Mesh block() {
  BlankConfig blank;
  blank.shape = "plate";
  blank.pattern = "coarse";
  blank.origin = Vec3(-0.5, -0.5, -0.25);
  blank.length = blank.width = 1;
  blank.thickness = 0.5;
  blank.cells_along = blank.cells_across = blank.cells_through = 2;
  return generate_blank(blank);
}

Mesh strip() {
  BlankConfig blank;
  blank.shape = "strip";
  blank.length = 1;
  blank.thickness = 0.25;
  blank.cells_along = 8;
  blank.cells_through = 2;
  return generate_blank(blank);
}

}  // namespace

std::vector<Row> long_runs(const Request& request) {
  constexpr double kTurns = 40;
  const Case cases[] = {
      {"cell", 0.5, false, square(1),
       [](SteppedBody& body, double) {  // stretches along x, gets thinner along y: strains of 1.5e-3
         for (std::size_t i = 0; i < body.x.size(); ++i) body.v[i] = 10 * Node(body.X[i][0], -body.X[i][1], 0, 0);
       }},
      {"spinning block", 0.5, false, block(),
       [](SteppedBody& body, double dt) {
         const double omega = 2 * M_PI * kTurns / (static_cast<double>(kSteps) * dt);
         for (std::size_t i = 0; i < body.x.size(); ++i) body.v[i] = omega * Node(-body.X[i][1], body.X[i][0], 0, 0);
       }},
      {"clamped strip", 0.5, true, strip(),
       [](SteppedBody& body, double) {  // thrown upwards: bends by a few per cent of its length
         for (std::size_t i = 0; i < body.x.size(); ++i) {
           if (body.X[i][0] < 1e-9) body.free[i] = Node::Zero();
           body.v[i] = Node(0, 30 * body.X[i][0] * body.X[i][0], 0, 0);
         }
       }}};
  std::vector<Row> rows;
  for (const Case& what : cases) {
    const std::string name = what.name;
    Figure volume("long_runs_" + name.substr(0, name.find(' ')) + "_volume", "A million steps: " + name, "steps / 1000", "mean V/V0 (area in 2D)");
    Figure energy("long_runs_" + name.substr(0, name.find(' ')) + "_energy", "A million steps: " + name, "steps / 1000", "energy / energy at the start");
    for (const std::string law : {"classical", "paper", "green_elastic"}) {
      const Clock clock;
      std::vector<Look> looks;
      std::string ended;
      try {
        looks = run(what, law);
      } catch (const Error& error) {
        ended = error.what();
      }
      if (!ended.empty()) {
        rows.push_back(just(name, law + ": ended early", kNothing, clock.seconds()));
        rows.back().note = ended;
        continue;
      }
      const Look &first = looks.front(), &last = looks.back();
      double off = 0, gained = 0, turned = 0;
      for (std::size_t i = 0; i < looks.size(); ++i) {
        const double at = static_cast<double>(kSteps) / 1000 * (static_cast<double>(i) + 0.5) / kLooks;
        volume.add(law, at, looks[i].volume);
        energy.add(law, at, looks[i].energy / first.energy);
        off = std::max(off, std::abs(looks[i].volume - first.volume));
        gained = std::max(gained, std::abs(looks[i].energy / first.energy - 1));
        turned = std::max(turned, std::abs(looks[i].momentum / first.momentum - 1));
      }
      const double time = clock.seconds();
      const bool is_new = law != "classical";
      rows.push_back(just(name, law + ": change of mean V/V0", last.volume - first.volume, time));
      rows.push_back(is_new ? at_most(name, law + ": mean V/V0, largest change", off, 1e-5, time) : just(name, law + ": mean V/V0, largest change", off, time));
      rows.push_back(just(name, law + ": change of energy", last.energy / first.energy - 1, time));
      rows.push_back(is_new ? at_most(name, law + ": energy, largest change", gained, 1e-3, time) : just(name, law + ": energy, largest change", gained, time));
      if (name == "spinning block") {
        rows.push_back(just(name, law + ": turns", last.angle / (2 * M_PI), time));
        rows.push_back(at_most(name, law + ": angular momentum, change", turned, 1e-9, time));
      } else if (!what.clamped) {
        rows.push_back(just(name, law + ": mean angle, degrees", last.angle * 180 / M_PI, time));
      } else {
        rows.push_back(just(name, law + ": turned about the clamp, degrees", last.angle * 180 / M_PI, time));
      }
    }
    volume.write(request.directory);
    energy.write(request.directory);
  }
  rows.front().note = "10^6 steps of half the stable one; values are means over 20000 steps, the first one included";
  return rows;
}

}  // namespace forming_sim::bench
