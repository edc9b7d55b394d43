// SPDX-License-Identifier: MIT
#include "sim/recording/observables.h"

#include <cctype>

namespace throng::recording {

namespace {

constexpr std::size_t kOfBodies = 7;  // numbers

}  // namespace

std::string path_part(std::string_view name) {
  if (name == ".") return "%2E";
  const auto is_hex = [&](std::size_t i) {
    return i < name.size() && std::isxdigit(static_cast<unsigned char>(name[i]));
  };
  std::string part;
  for (std::size_t i = 0; i < name.size(); ++i)
    if (name[i] == '/')
      part += "%2F";
    else if (name[i] == '%' && is_hex(i + 1) && is_hex(i + 2))
      part += "%25";
    else
      part += name[i];
  return part;
}

std::vector<Observable> observables_of(bool crowd, std::span<const Measure> measures,
                                       std::span<const AskedColumn> asked) {
  std::vector<Observable> all{{"kinetic_energy"}, {"potential_energy"}, {"momentum", 2},
                              {"contacts"},       {"max_overlap"},      {"mean_overlap"}};
  for (const AskedColumn& column : asked)
    all.push_back({column.name, column.numbers, true, column.bins.up_to});
  if (!crowd) return all;
  all.push_back({"agents"});
  all.push_back({"arrived"});
  for (const Measure& measure : measures)
    for (const char* column : columns(measure))
      all.push_back({"measure/" + path_part(measure.name) + "/" + column, 1, std::string("count") != column});
  return all;
}

std::vector<double> numbers_of(const Observables& of) {
  std::vector<double> numbers{of.kinetic_energy, of.potential_energy, of.momentum.x(), of.momentum.y(),
                              of.contacts,       of.max_overlap,      of.mean_overlap};
  numbers.insert(numbers.end(), of.asked.begin(), of.asked.end());
  if (!of.crowd) return numbers;
  numbers.push_back(of.crowd->agents);
  numbers.push_back(of.crowd->arrived);
  numbers.insert(numbers.end(), of.crowd->measures.begin(), of.crowd->measures.end());
  return numbers;
}

Observables observables_from(std::span<const double> n, bool crowd) {
  Observables result{n[0], n[1], {n[2], n[3]}, n[4], n[5], n[6]};
  if (!crowd)
    result.asked.assign(n.begin() + kOfBodies, n.end());
  else
    result.crowd = CrowdObservables{n[kOfBodies], n[kOfBodies + 1], {n.begin() + kOfBodies + 2, n.end()}};
  return result;
}

}  // namespace throng::recording
