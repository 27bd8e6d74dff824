// forming_bench calibrate [CURVE.csv E=... nu=...]: layers from a measured curve.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "figure.h"
#include "forming_sim/material/calibration.h"
#include "forming_sim/material/material_point.h"
#include "forming_sim/results/csv_file.h"
#include "forming_sim/results/text_file.h"
#include "rows.h"
#include "table.h"

namespace forming_sim::bench {
namespace {

/// VERIFICATION 3: plastic strains and stresses (MPa), and the layers to the digits printed there.
struct Verified {
  double E = 70500e6, nu = .34;
  std::vector<double> plastic{0, .002, .01, .03, .08, .20}, stress{160, 180, 210, 250, 300, 340};
  std::vector<double> weight{.88753672, .06710106, .02064581, .01220357, .00830681, .00420603};
  std::vector<double> yield{160, 337.83582, 999.17910, 2617.53731, 6613.43284, 16123.58209};
};

std::vector<Row> verified_curve() {
  const Verified v;
  const Clock clock;
  std::vector<CurvePoint> curve;
  for (std::size_t k = 0; k < v.plastic.size(); ++k) curve.push_back({v.plastic[k] + 1e6 * v.stress[k] / v.E, 1e6 * v.stress[k]});
  const std::vector<LayerConfig> layers = calibrate_layers(v.E, v.nu, curve);
  std::vector<Row> rows;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const std::string name = "verified curve, layer " + std::to_string(k + 1);
    const auto add = [&](const char* quantity, double found, double expected, double last_digit) {
      Row row = near(name, quantity, found, expected, 0, clock.seconds());
      row.holds = std::fabs(found - expected) <= 0.51 * last_digit;  // all printed digits
      rows.push_back(row);
    };
    add("weight", layers[k].weight, v.weight[k], 1e-8);
    add("yield stress, MPa", layers[k].hardening->yield_stress / 1e6, v.yield[k], 1e-5);
  }
  rows[0].note = "E 70.5 GPa, nu .34; holds: equal in all digits of the reference, 1e-8 of a weight and 1e-5 MPa";
  return rows;
}

/// Value of the argument NAME=number.
double argument(const std::vector<std::string>& arguments, const std::string& name) {
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i].compare(0, name.size() + 1, name + "=") != 0) continue;
    const std::string text = arguments[i].substr(name.size() + 1);
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value)) throw std::runtime_error(name + ": given \"" + text + "\"; right is a number, as in " + name + (name == "E" ? "=70.5e9 (Pa)" : "=0.34"));
    return value;
  }
  throw std::runtime_error(name + " is missing; right is CURVE.csv E=70.5e9 nu=0.34 (E in Pa)");
}

std::vector<CurvePoint> read_curve(const Table& table) {
  for (const std::string& column : table.columns)
    if (column != "true_strain" && column != "true_stress_Pa" && column != "true_stress_MPa")
      throw std::runtime_error(table.path + ": column " + column + " is not known; right are true_strain and true_stress_Pa or true_stress_MPa");
  const int strain = table.at("true_strain"), mega = table.find("true_stress_MPa"), plain = table.find("true_stress_Pa");
  if ((mega < 0) == (plain < 0)) throw std::runtime_error(table.path + ": right is one column of stress, true_stress_Pa or true_stress_MPa");
  std::vector<CurvePoint> curve;
  for (const auto& row : table.rows) curve.push_back({row[strain], mega < 0 ? row[plain] : 1e6 * row[mega]});
  return curve;
}

std::string yaml_of(double E, double nu, const std::vector<LayerConfig>& layers, const std::string& from) {
  std::string text = "# Perfectly plastic layers calibrated from " + from + ": for a scene's material, beside its density.\n";
  text += "youngs_modulus: " + csv_number(E) + "\npoissons_ratio: " + csv_number(nu) + "\nlayers:\n";
  for (const LayerConfig& layer : layers)
    text += "  - {weight: " + csv_number(layer.weight) + ", hardening: {curve: perfect, yield_stress: " + csv_number(layer.hardening->yield_stress) + "}}\n";
  return text;
}

std::vector<Row> from_curve(const Request& request) {
  const std::string& path = request.arguments[0];
  for (std::size_t i = 1; i < request.arguments.size(); ++i)
    if (request.arguments[i].compare(0, 2, "E=") != 0 && request.arguments[i].compare(0, 3, "nu=") != 0)
      throw std::runtime_error("argument " + request.arguments[i] + " is not known; right is CURVE.csv E=70.5e9 nu=0.34");
  const double E = argument(request.arguments, "E"), nu = argument(request.arguments, "nu");
  if (const auto fault = find_curve_fault(E, nu, {{1 / E, 1}})) throw std::runtime_error("given " + fault->sentence);  // of the moduli alone
  const Table table = read_table(path);
  const std::vector<CurvePoint> curve = read_curve(table);
  if (const auto fault = find_curve_fault(E, nu, curve)) throw std::runtime_error(table.place(fault->point) + ": given " + fault->sentence);
  const Clock clock;
  const std::vector<LayerConfig> layers = calibrate_layers(E, nu, curve);
  const std::string yaml = yaml_of(E, nu, layers, path);
  std::printf("%s\n", yaml.c_str());

  // Driven along the curve and back with the package's finite-strain law.
  MaterialConfig material;
  material.youngs_modulus = E;
  material.poissons_ratio = nu;
  material.layers = layers;
  MaterialPoint point(material);
  Figure figure("calibrate", "Layers from " + path, "true strain", "true stress, MPa");
  double at = 0, sigma = 0, worst = 0;
  const auto go = [&](double strain) {
    const int n = std::max(1, static_cast<int>(std::ceil(std::fabs(strain - at) / 1e-4)));
    for (int i = 1; i <= n; ++i) figure.add("layers, forth and back", at + (strain - at) * i / n, (sigma = point.uniaxial(std::exp(at + (strain - at) * i / n))) / 1e6);
    at = strain;
  };
  for (const CurvePoint& p : curve) {
    go(p.strain);
    figure.add("curve, measured", p.strain, p.stress / 1e6);
    worst = std::max(worst, std::fabs(sigma / p.stress - 1));
  }
  go(-at);
  figure.write(request.directory);
  if (!request.directory.empty()) replace_file(in_directory(request.directory, "layers.yaml"), yaml);

  std::vector<Row> rows;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const std::string name = "layer " + std::to_string(k + 1);
    rows.push_back(just(name, "weight", layers[k].weight, clock.seconds()));
    rows.push_back(just(name, "yield stress, Pa", layers[k].hardening->yield_stress, clock.seconds()));
  }
  rows.push_back(just("all layers", "farthest from a point of the curve, part", worst, clock.seconds()));
  rows.back().note = "the formula is exact in small strain; the layers were driven with the finite-strain law";
  return rows;
}

}  // namespace

std::vector<Row> calibrate(const Request& request) { return request.arguments.empty() ? verified_curve() : from_curve(request); }

}  // namespace forming_sim::bench
