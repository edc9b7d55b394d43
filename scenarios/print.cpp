// SPDX-License-Identifier: MIT
#include "scenarios/print.h"

#include <sstream>
#include <string_view>

#include "scenarios/path.h"
#include "scenarios/report.h"

namespace throng::scenarios {

namespace {

/// A basic string of TOML. What TOML wants escaped is.
std::string literal(std::string_view text) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string result = "\"";
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (byte < 0x20 || byte == 0x7f) {
      result += {'\\', 'u', '0', '0', kHex[byte >> 4], kHex[byte & 15]};
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string name(std::string_view key) {
  return is_bare_key(key) ? std::string(key) : literal(key);
}

/// A float of TOML: it has a point or an exponent, else it would come back as an integer.
std::string literal(double x) {
  std::string text = to_text(x);
  const bool plain = text.find_first_not_of("-0123456789") == std::string::npos;
  return plain ? text + ".0" : text;
}

void print_value(const toml::node& node, std::string& out);

void print_inline(const toml::table& table, std::string& out) {
  out += "{";
  bool first = true;
  for (const auto& [key, value] : table) {
    out += (first ? " " : ", ") + name(key.str()) + " = ";
    print_value(value, out);
    first = false;
  }
  out += " }";
}

void print_list(const toml::array& list, std::string& out) {
  out += "[";
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) out += ", ";
    print_value(*list.get(i), out);
  }
  out += "]";
}

void print_value(const toml::node& node, std::string& out) {
  if (const auto* table = node.as_table()) return print_inline(*table, out);
  if (const auto* list = node.as_array()) return print_list(*list, out);
  if (const auto* text = node.as_string()) {
    out += literal(text->get());
  } else if (const auto* x = node.as_floating_point()) {
    out += literal(x->get());
  } else if (const auto* i = node.as_integer()) {
    out += std::to_string(i->get());
  } else if (const auto* flag = node.as_boolean()) {
    out += flag->get() ? "true" : "false";
  } else {
    std::ostringstream stream;  // dates: no scenario has them, but the tree may
    node.visit([&](const auto& value) {
      if constexpr (toml::is_date<decltype(value)> || toml::is_time<decltype(value)> ||
                    toml::is_date_time<decltype(value)>)
        stream << value.get();
    });
    out += stream.str();
  }
}

bool is_list_of_tables(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (!list || list->empty()) return false;
  for (const toml::node& entry : *list)
    if (!entry.is_table()) return false;
  return true;
}

void print_fields(const toml::table& table, std::string& out) {
  for (const auto& [key, value] : table) {
    out += name(key.str()) + " = ";
    print_value(value, out);
    out += "\n";
  }
}

}  // namespace

std::string print(const toml::node& value) {
  std::string out;
  print_value(value, out);
  return out;
}

std::string print(const toml::table& root) {
  std::string out;
  for (const auto& [key, value] : root) {
    if (value.is_table() || is_list_of_tables(value)) continue;
    out += name(key.str()) + " = ";
    print_value(value, out);
    out += "\n";
  }
  for (const auto& [key, value] : root) {
    if (const auto* table = value.as_table()) {
      out += "\n[" + name(key.str()) + "]\n";
      print_fields(*table, out);
    } else if (is_list_of_tables(value)) {
      for (const toml::node& entry : *value.as_array()) {
        out += "\n[[" + name(key.str()) + "]]\n";
        print_fields(*entry.as_table(), out);
      }
    }
  }
  return out;
}

}  // namespace throng::scenarios
