// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "narrowphase/manifold.h"
#include "sim/contact/block_order.h"
#include "sim/state.h"

namespace throng {

/// Those that a contact begins with; none where nothing was kept.
inline BlockImpulses impulses_of(const ContactImpulse* kept) {
  return kept ? BlockImpulses{kept->normal, kept->tangent, kept->preload} : BlockImpulses{};
}

/// The contacts of the last step that pressed. They and the questions ascend by key: the search never goes
/// back.
class KeptImpulses {
 public:
  /// Keys below `first` won't be asked for.
  explicit KeptImpulses(std::span<const ContactImpulse> kept, std::uint64_t first = 0) : kept_(kept) {
    const auto below = [](const ContactImpulse& contact, std::uint64_t key) { return contact.key < key; };
    next_ = static_cast<std::size_t>(std::lower_bound(kept.begin(), kept.end(), first, below) - kept.begin());
  }

  /// The first contact under that key; null where nothing pressed.
  const ContactImpulse* find(std::uint64_t key) {
    while (next_ < kept_.size() && kept_[next_].key < key) ++next_;
    return next_ < kept_.size() && kept_[next_].key == key ? &kept_[next_] : nullptr;
  }

  /// What the i-th point of that manifold was; null where it didn't press. By its feature, whichever face
  /// described it; where two points were and are, none is forgotten for a new name, as corners that meet take
  /// turns in naming the pair: the two are the same as before in their order along the face, or taken to be.
  const ContactImpulse* find(std::uint64_t key, std::span<const std::uint32_t> features, std::size_t i) {
    if (!find(key)) return nullptr;
    const std::span<const ContactImpulse> kept = kept_.subspan(next_, count_at(next_));
    if (kept.size() == 2 && features.size() == 2) return &kept[were_swapped(kept, features) ? 1 - i : i];
    for (const ContactImpulse& contact : kept)
      if (is_same(contact, features[i])) return &contact;
    return nullptr;
  }

 private:
  static bool is_same(const ContactImpulse& kept, std::uint32_t feature) {
    return narrowphase::without_reference(kept.feature) == narrowphase::without_reference(feature);
  }

  static bool were_swapped(std::span<const ContactImpulse> kept, std::span<const std::uint32_t> features) {
    if (is_same(kept[0], features[0]) || is_same(kept[1], features[1])) return false;
    if (is_same(kept[0], features[1]) || is_same(kept[1], features[0])) return true;
    return narrowphase::reference_is_b(kept[0].feature) != narrowphase::reference_is_b(features[0]);
  }

  /// Points of the manifold there.
  std::size_t count_at(std::size_t first) const {
    return first + 1 < kept_.size() && kept_[first + 1].key == kept_[first].key ? 2 : 1;
  }

  std::span<const ContactImpulse> kept_;
  std::size_t next_;
};

}  // namespace throng
