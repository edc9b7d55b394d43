// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/state.h"

/// The contacts of a state as a checkpoint has them: arrays, one a quantity.
namespace throng::recording {

/// Contacts, an array a quantity: the struct's own padding has no defined bytes.
struct Columns {
  std::vector<std::uint64_t> key;
  std::vector<std::uint32_t> feature;
  std::vector<double> normal, tangent, rolling, preload;

  explicit Columns(std::size_t n) : key(n), feature(n), normal(n), tangent(n), rolling(n), preload(n) {}

  explicit Columns(const std::vector<ContactImpulse>& contacts) : Columns(contacts.size()) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const auto& [k, f, n, t, r, p] = contacts[i];  // a member added there belongs here too
      key[i] = k, feature[i] = f, normal[i] = n, tangent[i] = t, rolling[i] = r, preload[i] = p;
    }
  }

  std::vector<ContactImpulse> contacts() const {
    std::vector<ContactImpulse> result;
    result.reserve(key.size());
    for (std::size_t i = 0; i < key.size(); ++i)
      result.push_back({key[i], feature[i], normal[i], tangent[i], rolling[i], preload[i]});
    return result;
  }
};

inline std::vector<ContactImpulse> impulses(const std::vector<SleepingContact>& contacts) {
  std::vector<ContactImpulse> result;
  for (const SleepingContact& contact : contacts) result.push_back(contact.impulse);
  return result;
}

/// The same of those that sleep.
struct SleepingColumns : Columns {
  std::vector<std::uint32_t> island, a, b;
  std::vector<Vec> point;

  explicit SleepingColumns(std::size_t n) : Columns(n), island(n), a(n), b(n), point(n) {}

  explicit SleepingColumns(const std::vector<SleepingContact>& contacts)
      : Columns(impulses(contacts)), island(key.size()), a(key.size()), b(key.size()), point(key.size()) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const auto& [impulse, its_island, its_a, its_b, its_point] = contacts[i];  // as above
      island[i] = its_island, a[i] = its_a, b[i] = its_b, point[i] = its_point;
    }
  }

  std::vector<SleepingContact> contacts() const {
    std::vector<SleepingContact> result;
    result.reserve(key.size());
    for (const ContactImpulse& impulse : Columns::contacts()) {
      const std::size_t i = result.size();
      result.push_back({impulse, island[i], a[i], b[i], point[i]});
    }
    return result;
  }
};

/// All contacts of a state.
struct AllColumns {
  Columns discs, points;
  SleepingColumns sleeping_discs, sleeping_points;
};

template <class C, class F>
void for_each_column(C& all, F visit) {
  const auto shared = [&](auto& columns) {
    visit(columns.key), visit(columns.feature), visit(columns.normal), visit(columns.tangent),
        visit(columns.rolling), visit(columns.preload);
  };
  const auto sleeping = [&](auto& columns) {
    shared(columns);
    visit(columns.island), visit(columns.a), visit(columns.b), visit(columns.point);
  };
  shared(all.discs), shared(all.points);
  sleeping(all.sleeping_discs), sleeping(all.sleeping_points);
}

}  // namespace throng::recording
