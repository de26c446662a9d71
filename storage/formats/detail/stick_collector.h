// Gathers the knots that a reader of sticks finds, row by row, into sticks, with the report: what every
// reader of sticks has to do, whatever its format.
//   names    valid UTF-8, no control characters, blanks single, cut to what a project takes; reported;
//   z        by what the user told, else by what the file states, else positive down in the survey's unit,
//            which is reported as assumed;
//   lines    a knot without X and Y is placed by its inline and crossline; a knot with both is compared;
//   sticks   by number > by blank line (end_stick) > by change of plane, in the order of their first row;
//   repeated knots are skipped.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "storage/formats/detail/text_rows.h"
#include "storage/formats/sticks.h"

namespace footwall::formats::detail {

// As it stands in the file.
struct Knot {
  std::string_view name{};                       // empty: the file gives no name
  std::optional<std::int64_t> stick{};           // unset: the file does not number its sticks
  std::optional<std::array<double, 2>> lines{};  // inline and crossline; 0 0 stands for none
  std::optional<std::array<double, 2>> xy{};     // X and Y; 0 0 beside lines stands for none
  double z = 0;
};

class StickCollector {
 public:
  // Throws kUsage for units that cannot be converted into each other.
  explicit StickCollector(const SticksOptions& options);
  StickCollector(const StickCollector&) = delete;
  StickCollector& operator=(const StickCollector&) = delete;

  // What the file says of the z that follows: direction (unset: nothing) and unit ("ms", "s", "m", "ft";
  // empty: nothing). What the user told goes before it. May be called again, e.g. for each object of a file.
  void file_states(std::optional<bool> z_positive_up, std::string_view z_unit);
  // Throws RowError (at 0) for a knot that has neither X and Y nor, where the survey is known, lines.
  void add(const Knot& knot);
  // The next knot without a number starts another stick. Called at blank lines and the like; calls before the
  // first knot, after the last, or one after another, do no harm.
  void end_stick() { stick_ended_ = true; }
  // The format parts sticks by end_stick() and by nothing else, so that no plane is looked at.
  void parted_by_blank_lines() { parted_ = true; }
  void skip() { ++result_.report.skipped; }
  void reject(std::int64_t line, const RowError& why);
  std::int64_t read() const { return result_.report.read; }
  void assume(std::string what);  // once, however often it is called
  void rename(std::string_view old_name, std::string_view new_name);

  // Throws kFormat, with the first reason, where no row became a knot. what: "a Charisma fault stick"; hint:
  // how rows look.
  SticksImport finish(std::string_view what, std::string_view hint);

 private:
  // What stands for one name of the file, and where its rows go.
  struct Fault {
    std::string name;
    std::map<std::int64_t, std::size_t> numbered;  // stick number -> place in result_.sticks
    std::optional<std::size_t> open;               // the stick that unnumbered knots are added to
    std::int64_t unnumbered = 0;                   // sticks so far
  };
  std::string short_name(const std::string& name);
  Fault& fault_of(std::string_view name_in_file);
  std::size_t stick_of(Fault& fault, const std::optional<std::int64_t>& number);
  survey::WorldPoint placed(const Knot& knot, bool& in_line_numbers);
  double apart(const Knot& knot) const;
  void compare(const Knot& knot);
  void split_at_planes();
  void apply_z_rule(std::optional<bool> z_positive_up, std::string_view z_unit);

  SticksOptions options_;
  SticksImport result_;
  std::map<std::string, Fault> faults_;                       // by clean name, before it is cut
  std::map<std::string, Fault*, std::less<>> names_in_file_;  // several spellings may clean to one name
  decltype(names_in_file_)::iterator last_ = names_in_file_.end();
  std::set<std::string> cut_names_;
  std::vector<bool> numbered_;  // of each stick in result_
  double z_factor_ = 1;
  bool z_ruled_ = false;
  bool stick_ended_ = false;
  bool parted_ = false;  // end_stick() parted knots somewhere
  std::int64_t without_lines_ = 0, by_lines_ = 0, unnamed_ = 0, contradict_ = 0;
  std::string first_contradiction_;
};

// Writers: `name` as it can stand in a file whose names must not hold the characters `forbidden`, which
// become
// '_', and whose readers take runs of blanks for one; told in `renamed`. With `blanks`, blanks become '_'
// too.
std::string written_name(std::string_view name, std::string_view forbidden, bool blanks,
                         std::vector<std::string>& renamed);
// z as it is written: with the sign asked for, and never "-0".
double written_z(double z, const SticksWriteOptions& options);
// The numbers of the lines nearest to a point, 0 0 without a survey and beyond 2^31 lines.
std::array<std::int64_t, 2> nearest_lines(const survey::WorldPoint& point, const SticksWriteOptions& options);

}  // namespace footwall::formats::detail
