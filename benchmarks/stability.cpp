// forming_bench stability [CASE ...]: hard cases with verdicts.
#include "stability/stability.h"

#include <algorithm>
#include <stdexcept>

namespace forming_sim::bench {

std::unique_ptr<Simulation> tried(std::vector<Row>& rows, const std::string& name, const OneBody& run, double ledger, Code right) {
  auto sim = run.start();
  const std::atomic<bool> cancel{false};
  const Outcome outcome = sim->run(cancel);
  Row end = just(name, std::string("ends with ") + name_of(right), static_cast<double>(outcome.code), sim->wall_time());
  end.expected = static_cast<double>(right);
  end.error = end.found / end.expected - 1;
  end.holds = outcome.code == right;
  if (outcome.code != Code::success) end.note = outcome.message;
  rows.push_back(end);
  if (right == Code::success) rows.push_back(at_most(name, "ledger error over work", sim->balance_error(), ledger, sim->wall_time()));
  return sim;
}

std::vector<Row> stability(const Request& request) {
  struct Case {
    const char* name;
    std::vector<Row> (*run)(const Request&);
    bool on_request;
  };
  constexpr Case cases[] = {{"incompressible", nearly_incompressible, false}, {"large-strain", large_strain, false},      {"shapes", bad_shapes, false},
                            {"steps", many_steps, false},                     {"ten-million-steps", ten_million_steps, true}, {"spin", spin, false}, {"swings", free_swings, false},
                            {"impact", fast_impact, false},                   {"sudden", sudden_loads, false}};
  const std::vector<std::string>& asked = request.arguments;
  std::string known;
  for (const Case& one : cases) known += (known.empty() ? "" : ", ") + std::string(one.name);
  for (const std::string& name : asked)
    if (std::none_of(std::begin(cases), std::end(cases), [&](const Case& one) { return name == one.name; }))
      throw std::runtime_error("case " + name + " is not one of " + known);
  std::vector<Row> rows;
  for (const Case& one : cases)
    if (asked.empty() ? !one.on_request : std::find(asked.begin(), asked.end(), one.name) != asked.end())
      for (Row& row : one.run(request)) rows.push_back(std::move(row));
  return rows;
}

}  // namespace forming_sim::bench
