// Tables of faces and numbers: whatever is read has a face and a number that is finite or undefined.
#include <cmath>
#include <sstream>

#include "fuzz/target.h"
#include "storage/formats/face_values_csv.h"

namespace footwall::fuzz {
namespace {

bool run(const std::string& bytes) {
  std::istringstream in(bytes);
  std::int64_t line = 1;
  for (const auto& row : formats::face_values_csv::read(in, "throw")) {
    if (row.face.empty() || std::isinf(row.value) || row.line <= line) return false;
    line = row.line;
  }
  return true;
}

}  // namespace

Target fuzz_target() {
  return {{},
          {"face,value\n3-7.12,1.5\n\"1.0\",\ncell 8f2e00.1,nan\n",
           "\xEF\xBB\xBFx0,fault,throw,face\r\n1,\"F \"\"1\"\", east\",-2e3,1.0\r\n\r\n2,F2,+4,1.1\r\n"},
          run};
}

}  // namespace footwall::fuzz
