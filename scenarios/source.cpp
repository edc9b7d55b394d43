// SPDX-License-Identifier: MIT
#include "scenarios/source.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "scenarios/limits.h"
#include "scenarios/report.h"
#include "scenarios/scan.h"

namespace throng::scenarios {

namespace {

constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1a\n";  // as its files begin

/// The diagnosis of a file that is no TOML.
Diagnostic fault(int line, int column, std::string message) {
  return {Diagnostic::Severity::error, line, column, "", std::move(message), ""};
}

bool goes_on(char c) {
  return (c & 0xC0) == 0x80;  // a character that another byte began
}

/// What is written there, with no blank and no sign of TOML's in it; columns count characters, from 1.
std::string_view word_at(std::string_view text, std::size_t line, std::size_t column) {
  constexpr std::string_view kEnds = " \t\r\n,=[]{}#\"'", kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  for (; line > 1 && !text.empty(); --line)
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  text = text.substr(0, text.find('\n'));
  std::size_t at = 0;
  for (; at < text.size() && (column > 1 || goes_on(text[at])); ++at) column -= goes_on(text[at]) ? 0 : 1;
  const std::size_t begin = text.substr(0, at).find_last_of(kEnds) + 1;  // 0 where there is none
  return text.substr(begin, text.find_first_of(kEnds, at) - begin);
}

/// What other languages call true and false.
bool is_truth(std::string_view word) {
  constexpr std::string_view kTruths[] = {"true", "false", "yes", "no", "on", "off"};
  std::string small(word);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::ranges::find(kTruths, small) != std::end(kTruths);
}

/// What the parser says; of a word without quotes, and of what begins as nothing does, what a value is.
std::string why(const toml::parse_error& error, std::string_view text) {
  const std::string_view said = error.description();
  const bool no_value = said.ends_with("could not determine value type");
  if (!no_value && !said.starts_with("Error while parsing boolean") &&
      !said.starts_with("Error while parsing floating-point"))
    return std::string(said);
  const auto& place = error.source().begin;
  const std::string_view word = word_at(text, place.line, place.column);
  const bool is_word = !word.empty() && (std::isalpha(static_cast<unsigned char>(word[0])) || word[0] & 0x80);
  if (!no_value && !is_word) return std::string(said);
  if (is_truth(word))
    return in_quotes(word) + " is no value: say true or false, or " + in_quotes(word) + " in quotes, a text";
  return "a value is a text in quotes, as in " + in_quotes(is_word ? word : "pile") +
         ", a number, as in 0.5 or 1e-3, true, false, a list [a, b] or a table { key = a }";
}

}  // namespace

bool read_source(const std::string& file, std::string& text, std::vector<Diagnostic>& diagnostics) {
  std::error_code code;
  const auto fail = [&](std::string message) {
    diagnostics = {fault(0, 0, std::move(message))};
    return false;
  };
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) return fail("there is no such file");
  if (std::filesystem::is_directory(status)) return fail("is a folder; must be a file in TOML");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return fail("can't be read: " + std::string(std::strerror(errno)));
  std::vector<char> block(1 << 16);
  while (text.size() <= kMostBytes &&
         (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0))
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) return fail("can't be read to its end");
  if (text.starts_with(kHdf5)) {
    text.clear();
    return fail(
        "is HDF5, as recordings are, and no TOML; throng replay shows one, throng resume goes on with it");
  }
  if (text.size() <= kMostBytes) return true;
  text.clear();
  return fail("is larger than " + std::to_string(kMostBytes >> 20) + " MB; must be at most that");
}

std::optional<toml::table> parse(const std::string& text, const std::string& name,
                                 std::vector<Diagnostic>& diagnostics) {
  if (const Excess excess = find_excess(text); excess.line > 0) {
    diagnostics = {fault(excess.line, excess.column, excess.message)};
    return std::nullopt;
  }
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const auto& place = error.source().begin;
    diagnostics = {fault(static_cast<int>(place.line), static_cast<int>(place.column),
                         "this is no TOML: " + why(error, text))};
    return std::nullopt;
  }
}

}  // namespace throng::scenarios
