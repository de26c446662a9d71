#include "storage/formats/segy/layout_stanza.h"

#include <algorithm>
#include <cctype>

#include "storage/base/text.h"
#include "storage/formats/detail/letters.h"

namespace footwall::formats::segy {
namespace {

constexpr int kHeaderBytes = 240;

// The text with letters made small and blanks and control characters left out, for comparing stanza names.
std::string folded(std::string_view text) {
  std::string out = detail::lower(text);
  std::erase_if(out, [](char letter) { return static_cast<unsigned char>(letter) <= ' '; });
  return out;
}

// The value of `name="value"` in the inside of a tag; empty where it has no such attribute.
std::string_view attribute(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    const bool starts = at > 0 && std::isspace(static_cast<unsigned char>(tag[at - 1])) != 0;
    const std::size_t quote = at + name.size() + 1;
    if (!starts || quote >= tag.size() || tag[quote - 1] != '=' || tag[quote] != '"') continue;
    const std::size_t end = tag.find('"', quote + 1);
    if (end != std::string_view::npos) return tag.substr(quote + 1, end - quote - 1);
  }
  return {};
}

std::optional<WordType> type_of(std::string_view name) {
  if (name == "int4" || name == "uint4" || name == "coor4") return WordType::kInt32;
  if (name == "int2" || name == "uint2") return WordType::kInt16;
  if (name == "ieee32") return WordType::kIeee;
  if (name == "ibmfp") return WordType::kIbm;
  if (name == "ieee64") return WordType::kFloat64;
  return std::nullopt;
}

std::optional<HeaderWord>* place_for(std::string_view name, LayoutStanza& stanza) {
  if (name == "iline") return &stanza.inline_word;
  if (name == "xline") return &stanza.crossline_word;
  if (name == "cdp_x") return &stanza.x;
  if (name == "cdp_y") return &stanza.y;
  if (name == "offset") return &stanza.offset;
  return nullptr;
}

// From "((SEG:Layout" to the next stanza or the end; empty where it is not there.
std::string_view stanza_text(std::string_view text) {
  for (std::size_t at = text.find("(("); at != std::string_view::npos; at = text.find("((", at + 2)) {
    const std::size_t close = text.find("))", at);
    if (close == std::string_view::npos) return {};
    if (!folded(text.substr(at, std::min<std::size_t>(close - at, 64))).starts_with("((seg:layout")) continue;
    return text.substr(close + 2, text.find("((", close) - close - 2);
  }
  return {};
}

}  // namespace

std::optional<LayoutStanza> find_layout_stanza(std::string_view text) {
  const std::string_view body = stanza_text(text);
  LayoutStanza stanza;
  bool in_extension = false;  // entries of additional trace headers have byte numbers of their own
  for (std::size_t at = body.find('<'); at != std::string_view::npos; at = body.find('<', at + 1)) {
    const std::size_t end = body.find('>', at);
    if (end == std::string_view::npos) break;
    const std::string_view tag = body.substr(at + 1, end - at - 1);
    if (tag.starts_with("segy-layout")) stanza.name = attribute(tag, "name");
    if (tag.starts_with("extension")) in_extension = !tag.ends_with("/");
    if (tag.starts_with("/extension")) in_extension = false;
    if (!tag.starts_with("entry") || in_extension) continue;
    std::optional<HeaderWord>* place = place_for(attribute(tag, "name"), stanza);
    const auto byte = text::integer(attribute(tag, "byte"));
    const auto type = type_of(attribute(tag, "type"));
    if (place == nullptr || !byte || !type || *byte < 1 || *byte > kHeaderBytes + 1 - size_of(*type))
      continue;
    *place = HeaderWord(static_cast<int>(*byte), *type);
  }
  if (!stanza.inline_word && !stanza.crossline_word) return std::nullopt;
  return stanza;
}

}  // namespace footwall::formats::segy
