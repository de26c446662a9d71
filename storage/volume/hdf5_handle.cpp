#include "storage/volume/hdf5_handle.h"

#include <fmt/format.h>

#include <array>

namespace footwall::volume {
namespace {

std::recursive_mutex& one_at_a_time() {
  static std::recursive_mutex mutex;
  return mutex;
}

herr_t keep_innermost(unsigned, const H5E_error2_t* entry, void* into) {
  if (entry->desc != nullptr) *static_cast<std::string*>(into) = entry->desc;
  return 0;
}

[[noreturn]] void not_ours(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorCode::kFormat, fmt::format("{} is not a Footwall volume: {}", path.string(), why));
}

}  // namespace

Hdf5Use::Hdf5Use() : lock_(one_at_a_time()) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

bool Handle::reset() {
  const hid_t id = std::exchange(id_, -1);
  if (id < 0) return true;
  const Hdf5Use hdf5;
  return close_(id) >= 0;
}

std::string last_hdf5_reason() {
  const Hdf5Use hdf5;
  std::string reason;
  // Outermost first, so that the last one kept says what really went wrong.
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &reason);
  H5Eclear2(H5E_DEFAULT);
  return reason.empty() ? "HDF5 gives no reason" : reason;
}

void throw_hdf5(ErrorCode code, const std::string& what, const std::string& hint) {
  throw Error(code, fmt::format("{}: {}", what, last_hdf5_reason()), hint);
}

void quiet_hdf5() {
  const Hdf5Use hdf5;
}

Handle open_file_read_only(const std::filesystem::path& path, hid_t access_properties) {
  // Locks hang or fail on many cluster file systems, and a read-only reader needs none: files are replaced
  // whole.
  if (H5Pset_file_locking(access_properties, false, true) < 0) {
    throw_hdf5(ErrorCode::kInternal, "cannot turn HDF5's file locking off");
  }
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access_properties), H5Fclose);
  if (!file) throw_hdf5(ErrorCode::kCorrupt, fmt::format("{} cannot be opened as HDF5", path.string()));
  return file;
}

Handle open_dataset(hid_t file, const std::string& name, const std::filesystem::path& path) {
  for (std::size_t end = 0; end != std::string::npos;) {
    end = name.find('/', end + 1);
    const std::string part = name.substr(0, end);
    H5L_info_t link;
    if (H5Lget_info(file, part.c_str(), &link, H5P_DEFAULT) < 0) {
      H5Eclear2(H5E_DEFAULT);
      not_ours(path, fmt::format("it has no {}", part));
    }
    if (link.type != H5L_TYPE_HARD) not_ours(path, fmt::format("{} is a link, which is not followed", part));
  }
  Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset)
    throw_hdf5(ErrorCode::kCorrupt, fmt::format("{} of {} cannot be opened", name, path.string()));
  const Handle plan(H5Dget_create_plist(dataset.id()), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(plan.id());
  if (layout == H5D_VIRTUAL || H5Pget_external_count(plan.id()) != 0) {
    not_ours(path, fmt::format("{} keeps its values in another file", name));
  }
  if (H5Pget_nfilters(plan.id()) != 0) not_ours(path, fmt::format("{} is filtered or compressed", name));
  return dataset;
}

void write_attribute(hid_t object, const std::string& name, std::string_view text) {
  if (text.empty() || text.size() > kLongestAttribute) {
    throw Error(ErrorCode::kInvalid, fmt::format("the volume's {} has {} bytes; 1 to {} can be kept", name,
                                                 text.size(), kLongestAttribute));
  }
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), text.size());
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (!attribute || H5Awrite(attribute.id(), type.id(), text.data()) < 0) {
    throw_hdf5(ErrorCode::kIo, fmt::format("cannot write the volume's {}", name));
  }
}

std::optional<std::string> read_attribute(hid_t object, const std::string& name,
                                          const std::filesystem::path& path) {
  const htri_t exists = H5Aexists(object, name.c_str());
  if (exists < 0) throw_hdf5(ErrorCode::kCorrupt, fmt::format("attribute {} of {}", name, path.string()));
  if (exists == 0) return std::nullopt;
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (!attribute) throw_hdf5(ErrorCode::kCorrupt, fmt::format("attribute {} of {}", name, path.string()));
  const Handle type(H5Aget_type(attribute.id()), H5Tclose);
  const Handle space(H5Aget_space(attribute.id()), H5Sclose);
  const std::size_t size = H5Tget_size(type.id());
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0 ||
      H5Sget_simple_extent_type(space.id()) != H5S_SCALAR || size == 0 || size > kLongestAttribute) {
    not_ours(path,
             fmt::format("its attribute {} is not a text of at most {} bytes", name, kLongestAttribute));
  }
  std::string text(size, '\0');
  if (H5Aread(attribute.id(), type.id(), text.data()) < 0) {
    throw_hdf5(ErrorCode::kCorrupt, fmt::format("attribute {} of {}", name, path.string()));
  }
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

}  // namespace footwall::volume
