// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

namespace throng::recording {

/// The canonical prefix code of RFC 1951 for symbols that occur so often, of `longest` bits at most: that of
/// Huffman (1952), with counts evened out until it is short enough. A symbol that does not occur has length
/// 0; one that alone occurs has length 1.
template <std::size_t symbols>
struct HuffmanCode {
  std::array<std::uint8_t, symbols> length{};
  std::array<std::uint16_t, symbols> bits{};  ///< the first one lowest, as deflate writes them

  HuffmanCode(std::array<std::uint32_t, symbols> count, unsigned longest) {
    while (find_lengths(count) > longest)
      for (std::uint32_t& n : count)
        if (n > 0) n = n / 2 + 1;
    find_bits(longest);
  }

 private:
  /// Returns the greatest.
  unsigned find_lengths(const std::array<std::uint32_t, symbols>& count) {
    struct Node {
      std::uint64_t weight;
      std::uint32_t index;
      bool operator>(const Node& other) const {
        return weight != other.weight ? weight > other.weight : index > other.index;
      }
    };
    std::vector<std::uint32_t> parent(2 * symbols, 0);
    std::priority_queue<Node, std::vector<Node>, std::greater<>> nodes;
    for (std::uint32_t symbol = 0; symbol < symbols; ++symbol)
      if (count[symbol] > 0) nodes.push({count[symbol], symbol});
    std::uint32_t next = symbols;
    if (nodes.size() == 1) parent[nodes.top().index] = next++;
    while (nodes.size() > 1) {
      const Node a = nodes.top();
      nodes.pop();
      const Node b = nodes.top();
      nodes.pop();
      parent[a.index] = parent[b.index] = next;
      nodes.push({a.weight + b.weight, next++});
    }
    std::vector<std::uint8_t> depth(2 * symbols, 0);
    for (std::uint32_t node = next - 1; node-- > symbols;) depth[node] = depth[parent[node]] + 1;
    for (std::uint32_t symbol = 0; symbol < symbols; ++symbol)
      length[symbol] = count[symbol] > 0 ? static_cast<std::uint8_t>(depth[parent[symbol]] + 1) : 0;
    return *std::ranges::max_element(length);
  }

  void find_bits(unsigned longest) {
    std::uint32_t code = 0;
    for (unsigned n = 1; n <= longest; ++n, code <<= 1)
      for (std::size_t symbol = 0; symbol < symbols; ++symbol)
        if (length[symbol] == n) bits[symbol] = reversed(code++, n);
  }

  static std::uint16_t reversed(std::uint32_t code, unsigned n) {
    std::uint32_t result = 0;
    for (unsigned i = 0; i < n; ++i) result |= (code >> i & 1) << (n - 1 - i);
    return static_cast<std::uint16_t>(result);
  }
};

}  // namespace throng::recording
