// Makes the case tables of isosurfaces: make_tables OUTPUT.cpp. It checks every entry, and all of them
// against sampled trilinear fields; a fault fails the build.
#include <exception>
#include <fstream>
#include <iostream>

#include "engine/isosurface/tables/check.h"
#include "engine/isosurface/tables/write.h"

namespace {

using namespace footwall::isosurface::tables;

constexpr int kSamples = 40;  // fields of each sign case

bool report(unsigned signs, unsigned alternative, const std::string& fault) {
  if (fault.empty()) return true;
  std::cerr << "make_tables: signs " << signs << ", alternative " << alternative << ": " << fault << "\n";
  return false;
}

bool are_right(const std::vector<SignCase>& all) {
  bool right = true;
  for (unsigned signs = 0; signs < 256; ++signs) {
    for (const auto& [alternative, entry] : all[signs].entries)
      right = report(signs, alternative, fault_of(signs, alternative, entry, false)) && right;
    for (const auto& [alternative, entry] : all[signs].fans)
      right = report(signs, alternative, fault_of(signs, alternative, entry, true)) && right;
  }
  int met = 0;
  const std::string fault = fault_against_samples(all, kSamples, met);
  if (!fault.empty()) std::cerr << "make_tables: " << fault << "\n";
  return right && fault.empty();
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "make_tables OUTPUT.cpp\n";
    return 2;
  }
  try {
    const std::vector<SignCase> all = all_cases();
    if (!are_right(all)) return 1;
    std::ofstream out(arguments[1], std::ios::binary);
    out << as_source(all);
    out.close();
    if (!out) {
      std::cerr << "make_tables: cannot write " << arguments[1] << "\n";
      return 1;
    }
  } catch (const std::exception& error) {
    std::cerr << "make_tables: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
