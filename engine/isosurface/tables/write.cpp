#include "engine/isosurface/tables/write.h"

#include <sstream>
#include <stdexcept>

#include "engine/isosurface/tables/cell.h"

namespace footwall::isosurface::tables {
namespace {

constexpr unsigned kNone = 0xFFFF;

// One set of patterns: the pool of its triangles, its patterns as places in it, and which of them an
// alternative has.
struct Pool {
  std::vector<std::array<int, 3>> triangles;
  std::ostringstream patterns;
  unsigned count = 0;
  std::vector<unsigned> pattern_of;

  void add(const std::map<unsigned, Entry>& entries, bool decided, const std::string& name) {
    const std::size_t first = pattern_of.size();
    pattern_of.resize(first + (decided ? 1 : 256), kNone);
    for (const auto& [alternative, entry] : entries) {
      pattern_of[first + alternative] = count++;
      patterns << "    {std::span(" << name << "Triangles).subspan(" << triangles.size() << ", "
               << entry.filling.triangles.size() << "), "
               << (entry.filling.centre_edges != 0 ? "true" : "false") << ", " << entry.filling.centre_edges
               << "},\n";
      triangles.insert(triangles.end(), entry.filling.triangles.begin(), entry.filling.triangles.end());
    }
  }
};

template <class List>
void write_numbers(std::ostringstream& out, const char* type, const std::string& name, const List& list) {
  out << "constexpr std::array<" << type << ", " << list.size() << "> " << name << "{";
  for (std::size_t n = 0; n < list.size(); ++n) out << (n % 24 == 0 ? "\n    " : " ") << list[n] << ",";
  out << "};\n\n";
}

void write_pool(std::ostringstream& out, const Pool& pool, const std::string& name) {
  out << "constexpr std::array<std::array<std::uint8_t, 3>, " << pool.triangles.size() << "> " << name
      << "Triangles{{";
  for (std::size_t n = 0; n < pool.triangles.size(); ++n) {
    const auto& [a, b, c] = pool.triangles[n];
    out << (n % 8 == 0 ? "\n    " : " ") << "{" << a << ", " << b << ", " << c << "},";
  }
  out << "}};\n\n";
  out << "constexpr std::array<Pattern, " << pool.count << "> " << name << "Patterns{{\n"
      << pool.patterns.str() << "}};\n\n";
  write_numbers(out, "std::uint16_t", name + "PatternOf", pool.pattern_of);
}

void write_packed(std::ostringstream& out, const std::vector<SignCase>& all) {
  out << "constinit const std::array<PackedPattern, 256> kPacked{{\n";
  for (const SignCase& each : all) {
    if (each.entries.size() > 1) {
      out << "    {PackedPattern::kUndecided, {}},\n";
      continue;
    }
    const Filling& filling = each.entries.at(0).filling;
    if (filling.triangles.size() > 5 || filling.centre_edges != 0)
      throw std::runtime_error("a decided case that does not fit into PackedPattern");
    out << "    {" << filling.triangles.size() << ", {";
    for (const auto& [a, b, c] : filling.triangles) out << a << ", " << b << ", " << c << ", ";
    out << "}},\n";
  }
  out << "}};\n";
}

}  // namespace

std::string as_source(const std::vector<SignCase>& all) {
  Pool patterns;
  Pool fans;
  std::vector<unsigned> first;
  std::vector<unsigned> cut;
  std::vector<unsigned> ambiguous;
  for (unsigned signs = 0; signs < 256; ++signs) {
    const bool decided = all[signs].entries.size() == 1;
    first.push_back(static_cast<unsigned>(patterns.pattern_of.size()));
    patterns.add(all[signs].entries, decided, "kFilled");
    fans.add(all[signs].fans, decided, "kFanned");
    ambiguous.push_back(ambiguous_faces(signs));
    unsigned edges = 0;
    for (int edge = 0; edge < 12; ++edge) edges |= is_cut(signs, edge) ? 1U << edge : 0;
    cut.push_back(edges);
  }
  std::ostringstream out;
  out << "// Written by the build (engine/isosurface/tables); not to be edited.\n"
         "#include \"engine/isosurface/case_tables.h\"\n\n"
         "namespace footwall::isosurface::tables {\nnamespace {\n\n";
  write_pool(out, patterns, "kFilled");
  write_pool(out, fans, "kFanned");
  write_numbers(out, "std::uint16_t", "kFirstPattern", first);
  write_numbers(out, "std::uint16_t", "kCut", cut);
  write_numbers(out, "std::uint8_t", "kAmbiguous", ambiguous);
  out << "}  // namespace\n\n"
         "constinit const std::array<std::uint8_t, 256> kAmbiguousFaces = kAmbiguous;\n"
         "constinit const std::array<std::uint16_t, 256> kCutEdges = kCut;\n"
         "constinit const std::array<std::uint16_t, 256> kFirst = kFirstPattern;\n"
         "constinit const std::span<const std::uint16_t> kPatternOf = kFilledPatternOf;\n"
         "constinit const std::span<const Pattern> kPatterns = kFilledPatterns;\n"
         "constinit const std::span<const std::uint16_t> kFanOf = kFannedPatternOf;\n"
         "constinit const std::span<const Pattern> kFans = kFannedPatterns;\n\n";
  write_packed(out, all);
  out << "\n}  // namespace footwall::isosurface::tables\n";
  return out.str();
}

}  // namespace footwall::isosurface::tables
