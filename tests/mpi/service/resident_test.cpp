#include "engine/service/resident/resident.h"

#include <map>

#include "engine/extract/extract.h"
#include "engine/extract/registry.h"
#include "engine/mesh/operation.h"
#include "engine/service/wire.h"
#include "mpi/extract/same_bits.h"
#include "mpi/service/made_values.h"
#include "mpi/service/resident_case.h"
#include "rounds.h"
#include "storage/volume/volume_reader.h"

namespace footwall::service {
namespace {

using extract::Face;
using extract::FaceIdentity;
using extract::FaceStatistics;
using Numbers = std::map<FaceIdentity, FaceStatistics>;

constexpr survey::Index kDims{23, 19, 14};

class ResidentEngine : public ResidentCase {
 protected:
  ResidentEngine() { path = write_volume("random.h5", kDims, made_value); }
  std::filesystem::path path;
};

// What a full extraction on one rank gives.
Numbers expected(const std::filesystem::path& path, const std::map<FaceIdentity, Face>& model,
                 extract::Options options = {}) {
  if (options.compute.empty()) options.compute = extract::usual_computations();
  const comm::Communicator alone(MPI_COMM_SELF);
  const volume::VolumeReader reader(path);
  std::vector<Face> faces;
  for (const auto& [name, face] : model) faces.push_back(face);
  const auto result = extract::extract_all(
      alone, {reader.info().dims, reader.info().statistics.max_abs, faces}, options,
      [&](const survey::Box& box, std::span<float> values) { reader.read(box, values); });
  Numbers numbers;
  for (std::size_t n = 0; n < faces.size(); ++n) numbers.emplace(identity_of(faces[n]), result.faces[n]);
  return numbers;
}

Numbers numbers_of(const std::vector<v1::ExtractReply>& replies) {
  Numbers numbers;
  for (const v1::ExtractReply& reply : replies) {
    for (const NumberedFace& each : numbers_from(reply.numbers())) {
      EXPECT_TRUE(numbers.emplace(each.face, each.statistics).second) << "a face came twice";
    }
  }
  return numbers;
}

void expect_same(const Numbers& got, const Numbers& want) {
  ASSERT_EQ(got.size(), want.size());
  for (const auto& [name, statistics] : want) {
    const auto found = got.find(name);
    ASSERT_NE(found, got.end()) << "fault " << name.fault << ", face " << name.n;
    EXPECT_TRUE(extract::same_bits(found->second, statistics))
        << "fault " << name.fault << ", face " << name.n;
  }
}

std::string opened(Client& client, const std::filesystem::path& path) {
  const auto replies = client.ask<v1::OpenVolumeReply>(open_command(path));
  return replies.back().opened().volume();
}

v1::Command extract_command(const std::string& volume, const std::vector<std::string>& compute = {}) {
  v1::Command command;
  command.mutable_extract()->set_volume(volume);
  for (const std::string& each : compute) command.mutable_extract()->mutable_options()->add_compute(each);
  return command;
}

v1::Command put_command(std::uint64_t edit, const std::vector<Face>& faces) {
  v1::Command command;
  command.mutable_edit_model()->set_edit(edit);
  *command.mutable_edit_model()->add_edits()->mutable_put() = message_of(std::span(faces));
  return command;
}

// Random batches on the engine's model and on this one.
class Editor {
 public:
  explicit Editor(unsigned seed) : random_(seed) {}

  v1::EditBatch batch() {
    v1::EditBatch batch;
    batch.set_edit(++edit_);
    std::vector<Face> put;
    std::map<FaceIdentity, Face> later = model;
    for (unsigned n = 1 + random_() % 9; n > 0; --n) {
      const Face face =
          made_face(random_, kDims, 1 + random_() % 3, static_cast<std::int32_t>(random_() % 60));
      put.push_back(face);
      later[identity_of(face)] = face;
    }
    *batch.add_edits()->mutable_put() = message_of(std::span(put));
    std::vector<FaceIdentity> gone;
    for (unsigned n = random_() % 4; n > 0 && !later.empty(); --n) {
      auto at = later.begin();
      std::advance(at, random_() % later.size());
      gone.push_back(at->first);
      later.erase(at);
    }
    *batch.add_edits()->mutable_remove() = message_of(std::span<const FaceIdentity>(gone));
    model = later;
    return batch;
  }
  std::uint64_t edit() const { return edit_; }

  std::map<FaceIdentity, Face> model;

 private:
  std::mt19937 random_;
  std::uint64_t edit_ = 0;
};

TEST_F(ResidentEngine, GivesWhatAFullExtractionGivesAfterRandomEdits) {
  run([&](Client& client) {
    const std::string volume = opened(client, path);
    Editor editor(3);
    Numbers known;
    for (int round = 0; round < rounds(12); ++round) {
      v1::Command edit;
      *edit.mutable_edit_model() = editor.batch();
      const auto edited = client.ask<v1::EditModelReply>(edit);
      ASSERT_EQ(edited.size(), 1U);
      EXPECT_EQ(edited[0].faces(), static_cast<std::int64_t>(editor.model.size()));
      const Numbers want = expected(path, editor.model);
      v1::Command command = extract_command(volume);
      command.mutable_extract()->set_changed_only(round % 4 != 3);
      const auto replies = client.ask<v1::ExtractReply>(command);
      EXPECT_EQ(replies.back().done().edit(), editor.edit());
      if (round == 0 || round % 4 == 3) {
        known = numbers_of(replies);
        EXPECT_EQ(replies.back().done().checksum().size(), 16U);
      } else {
        for (const auto& [name, statistics] : numbers_of(replies)) known[name] = statistics;
        std::erase_if(known, [&](const auto& each) { return !editor.model.contains(each.first); });
      }
      expect_same(known, want);
    }
    // Nothing changed, nothing is computed.
    v1::Command command = extract_command(volume);
    command.mutable_extract()->set_changed_only(true);
    EXPECT_EQ(client.ask<v1::ExtractReply>(command).back().done().faces(), 0);
  });
}

TEST_F(ResidentEngine, ComputesOffsetsAndSomeFacesAlone) {
  run([&](Client& client) {
    const std::string volume = opened(client, path);
    Editor editor(5);
    v1::Command edit;
    for (int n = 0; n < 5; ++n) {
      *edit.mutable_edit_model() = editor.batch();
      client.ask<v1::EditModelReply>(edit);
    }
    extract::Options how;
    how.compute = {"contrast", "offset"};
    const Numbers want = expected(path, editor.model, how);
    v1::Command command = extract_command(volume, how.compute);
    expect_same(numbers_of(client.ask<v1::ExtractReply>(command)), want);

    std::vector<FaceIdentity> only{editor.model.begin()->first, editor.model.rbegin()->first};
    *command.mutable_extract()->mutable_only() = message_of(std::span<const FaceIdentity>(only));
    const Numbers some = numbers_of(client.ask<v1::ExtractReply>(command));
    ASSERT_EQ(some.size(), 2U);
    for (const auto& [name, statistics] : some) EXPECT_TRUE(extract::same_bits(statistics, want.at(name)));

    only.push_back({99, 99, 99});
    *command.mutable_extract()->mutable_only() = message_of(std::span<const FaceIdentity>(only));
    const auto error = client.error_of<v1::ExtractReply>(command);
    ASSERT_TRUE(error);
    EXPECT_NE(error->message().find("face 99 of fault 99"), std::string::npos);
  });
}

TEST_F(ResidentEngine, SeesTheModelFromAVolumeThatCoversAPartOfTheSurvey) {
  const survey::Index origin{5, 3, 2};
  const auto part = write_volume("part.h5", {9, 11, 8}, made_value, origin);
  run([&](Client& client) {
    const std::string volume = opened(client, part);
    const std::string whole = opened(client, path);
    std::mt19937 random(7);
    std::map<FaceIdentity, Face> in_survey;
    std::map<FaceIdentity, Face> in_part;
    const auto put = [&](std::uint64_t edit, int count) {
      std::vector<Face> faces;
      for (int n = 0; n < count; ++n)
        faces.push_back(made_face(random, kDims, 1 + n % 2, static_cast<std::int32_t>(random() % 50)));
      std::map<FaceIdentity, Face> last;  // of a name that comes twice
      for (const Face& face : faces) last[identity_of(face)] = face;
      faces.clear();
      for (const auto& [name, face] : last) {
        faces.push_back(face);
        in_survey[name] = face;
        Face& here = in_part[name] = face;
        for (survey::LatticePoint& p : here.triangle) p = {p.i - 5 * 256, p.j - 3 * 256, p.k - 2 * 256};
      }
      return put_command(edit, faces).edit_model();
    };
    // All, those that changed, a drag, some, with offsets: each from both volumes.
    v1::Command edit;
    *edit.mutable_edit_model() = put(1, 40);
    client.ask<v1::EditModelReply>(edit);
    expect_same(numbers_of(client.ask<v1::ExtractReply>(extract_command(volume))), expected(part, in_part));
    expect_same(numbers_of(client.ask<v1::ExtractReply>(extract_command(whole))), expected(path, in_survey));
    const auto changed_of = [&](const std::string& of, const auto& file, const auto& model) {
      v1::Command command = extract_command(of);
      command.mutable_extract()->set_changed_only(true);
      Numbers numbers = numbers_of(client.ask<v1::ExtractReply>(command));
      Numbers want = expected(file, model);
      std::erase_if(want, [&](const auto& each) { return !numbers.contains(each.first); });
      EXPECT_GT(numbers.size(), 2U);
      expect_same(numbers, want);
    };
    *edit.mutable_edit_model() = put(2, 9);
    client.ask<v1::EditModelReply>(edit);
    changed_of(volume, part, in_part);
    changed_of(whole, path, in_survey);
    v1::Command live;
    live.mutable_live()->set_volume(volume);
    *live.mutable_live()->add_batches() = put(3, 7);
    Numbers moved;
    for (const auto& reply : client.ask<v1::LiveReply>(live)) {
      for (const NumberedFace& each : numbers_from(reply.numbers())) moved[each.face] = each.statistics;
    }
    Numbers want = expected(part, in_part);
    std::erase_if(want, [&](const auto& each) { return !moved.contains(each.first); });
    EXPECT_GT(moved.size(), 2U);
    expect_same(moved, want);
    extract::Options with_offset;
    with_offset.compute = {"mean", "offset"};
    expect_same(numbers_of(client.ask<v1::ExtractReply>(extract_command(volume, with_offset.compute))),
                expected(part, in_part, with_offset));
    // The model itself stays where it was put; voxels of a face stand in the survey.
    v1::Command read;
    read.mutable_read_model();
    std::size_t faces = 0;
    for (const auto& reply : client.ask<v1::ReadModelReply>(read)) {
      for (const Face& face : faces_from(reply.faces())) {
        EXPECT_EQ(face, in_survey.at(identity_of(face)));
        ++faces;
      }
    }
    EXPECT_EQ(faces, in_survey.size());
    v1::Command voxels;
    voxels.mutable_face_voxels()->set_volume(volume);
    for (const int corner : {6, 5, 3, 12, 6, 4, 8, 12, 9})
      voxels.mutable_face_voxels()->add_corners(corner * 256);
    std::size_t there = 0;
    for (const auto& reply : client.ask<v1::FaceVoxelsReply>(voxels)) {
      for (int n = 0; n < reply.values_size(); ++n, ++there) {
        const float value =
            made_value({reply.places(3 * n) - 5, reply.places(3 * n + 1) - 3, reply.places(3 * n + 2) - 2});
        EXPECT_TRUE(std::isnan(value) ? std::isnan(reply.values(n)) : value == reply.values(n));
      }
    }
    EXPECT_GT(there, 20U);
  });
}

TEST_F(ResidentEngine, RemembersAFewKindsOfExtractionsAndBeginsOthersAgain) {
  run([&](Client& client) {
    const std::string volume = opened(client, path);
    std::mt19937 random(2);
    std::vector<Face> faces;
    for (std::int32_t n = 0; n < 20; ++n) faces.push_back(made_face(random, kDims, 1, n));
    client.ask<v1::EditModelReply>(put_command(1, faces));
    std::vector<v1::Command> kinds;
    for (const std::vector<std::string>& compute : std::vector<std::vector<std::string>>{
             {"mean"}, {"min"}, {"max"}, {"contrast"}, {"offset"}, {"variance"}}) {
      kinds.push_back(extract_command(volume, compute));
      kinds.back().mutable_extract()->set_changed_only(true);
      EXPECT_EQ(client.ask<v1::ExtractReply>(kinds.back()).back().done().faces(), 20);
    }
    client.ask<v1::EditModelReply>(put_command(2, {made_face(random, kDims, 1, 7)}));
    EXPECT_EQ(client.ask<v1::ExtractReply>(kinds.back()).back().done().faces(), 1);
    EXPECT_EQ(client.ask<v1::ExtractReply>(kinds.front()).back().done().faces(), 20);
    // A fault's offsets hang together.
    EXPECT_EQ(client.ask<v1::ExtractReply>(kinds[4]).back().done().faces(), 20);
  });
}

TEST_F(ResidentEngine, LiveStepsAnswerOnceAndLeaveOutWhatIsRefused) {
  run([&](Client& client) {
    const std::string volume = opened(client, path);
    Editor editor(8);
    Numbers known;
    for (int round = 0; round < rounds(10); ++round) {
      v1::Command command;
      v1::LiveStep& step = *command.mutable_live();
      step.set_volume(volume);
      for (int n = round % 3; n >= 0; --n) *step.add_batches() = editor.batch();
      v1::EditBatch& refused = *step.add_batches();
      refused = step.batches(0);  // its number is not new
      const auto replies = client.ask<v1::LiveReply>(command);
      ASSERT_EQ(replies.size(), 2U);
      EXPECT_EQ(replies[0].failure().code(), "invalid");
      EXPECT_EQ(replies[0].edit(), refused.edit());
      EXPECT_EQ(replies[1].edit(), editor.edit());
      for (const NumberedFace& each : numbers_from(replies[1].numbers())) known[each.face] = each.statistics;
      for (const FaceIdentity& name : names_from(replies[1].removed())) {
        EXPECT_EQ(known.erase(name), 1U);
      }
      expect_same(known, expected(path, editor.model));
    }
  });
}

TEST_F(ResidentEngine, MeshOperationsAndEditsOfFaultsLiveBesideEachOther) {
  run([&](Client& client) {
    const std::string volume = opened(client, path);
    std::mt19937 random(4);
    const Face face = made_face(random, kDims, 2, 0);
    client.ask<v1::EditModelReply>(put_command(1, {face}));
    v1::Command edit;
    const auto add = [&](const mesh::Operation& operation) {
      const auto bytes = mesh::encode(std::span(&operation, 1));
      edit.mutable_edit_model()->add_edits()->set_mesh(bytes.data(), bytes.size());
    };
    add(mesh::CreateMesh{{{0, 0, 0}, {2000, 0, 100}, {2000, 2000, 900}, {0, 2000, 300}},
                         {{0, 1, 2}, {0, 2, 3}}});
    add(mesh::MoveVertex{0, 2, {2500, 2100, 1000}});
    const auto made = client.ask<v1::EditModelReply>(edit);
    ASSERT_EQ(made[0].made_size(), 2);
    EXPECT_EQ(made[0].made(0).mesh(), 0);
    EXPECT_EQ(made[0].edit(), 2U);
    std::map<FaceIdentity, Face> model{{identity_of(face), face}};
    const survey::LatticePoint a{0, 0, 0}, b{2000, 0, 100}, c{2500, 2100, 1000}, d{0, 2000, 300};
    model[{-1, 0, 0}] = {-1, 0, 0, {a, b, c}};
    model[{-1, 0, 1}] = {-1, 0, 1, {a, c, d}};
    expect_same(numbers_of(client.ask<v1::ExtractReply>(extract_command(volume))), expected(path, model));
    // And what is there can be read back.
    v1::Command read;
    read.mutable_read_model()->add_faults(-1);
    const auto faces = client.ask<v1::ReadModelReply>(read);
    ASSERT_EQ(faces.size(), 1U);
    EXPECT_EQ(faces_from(faces[0].faces()), (std::vector<Face>{model.at({-1, 0, 0}), model.at({-1, 0, 1})}));
  });
}

TEST_F(ResidentEngine, EveryFailureIsTheCallsOwnAndLeavesTheStateAsItWas) {
  std::filesystem::path broken = folder / "broken.h5";
  if (world.rank() == 0) std::ofstream(broken) << "no volume";
  run([&](Client& client) {
    const std::string volume = opened(client, path);
    std::mt19937 random(4);
    client.ask<v1::EditModelReply>(put_command(7, {made_face(random, kDims, 1, 0)}));
    const std::uint64_t hash = client.hash();
    const auto code = [](const std::optional<Error>& error) {
      return error ? std::string(name_of(error->code())) : "none";
    };
    EXPECT_EQ(code(client.error_of<v1::OpenVolumeReply>(open_command(broken))), "format");
    EXPECT_EQ(code(client.error_of<v1::OpenVolumeReply>(open_command(folder / "absent.h5"))), "not_found");
    EXPECT_EQ(code(client.error_of<v1::OpenVolumeReply>(open_command("relative.h5"))), "usage");
    v1::Command named = open_command(path);
    named.mutable_open_volume()->mutable_volume()->set_checksum("0123456789abcdef");
    EXPECT_EQ(code(client.error_of<v1::OpenVolumeReply>(named)), "invalid");
    named.mutable_open_volume()->mutable_volume()->clear_path();
    EXPECT_EQ(code(client.error_of<v1::OpenVolumeReply>(named)), "not_found");
    EXPECT_EQ(code(client.error_of<v1::ExtractReply>(extract_command("0123456789abcdef"))), "not_found");
    EXPECT_EQ(code(client.error_of<v1::ExtractReply>(extract_command(volume, {"nonsense"}))), "usage");
    EXPECT_EQ(code(client.error_of<v1::EditModelReply>(put_command(7, {}))), "invalid");
    EXPECT_EQ(code(client.error_of<v1::EditModelReply>(put_command(8, {made_face(random, kDims, -4, 0)}))),
              "invalid");
    v1::Command live;
    live.mutable_live()->set_volume(volume);
    live.mutable_live()->mutable_options()->add_compute("offset");
    *live.mutable_live()->add_batches() = put_command(9, {made_face(random, kDims, 1, 3)}).edit_model();
    EXPECT_EQ(code(client.error_of<v1::LiveReply>(live)), "unsupported");
    v1::Command close;
    close.mutable_close_volume()->set_volume("0123456789abcdef");
    EXPECT_EQ(code(client.error_of<v1::CloseVolumeReply>(close)), "not_found");
    EXPECT_EQ(code(client.error_of<v1::CloseVolumeReply>(v1::Command())), "unsupported");

    EXPECT_EQ(client.hash(), hash);
    EXPECT_EQ(client.ask<v1::ExtractReply>(extract_command(volume)).back().done().faces(), 1);
    close.mutable_close_volume()->set_volume(volume);
    client.ask<v1::CloseVolumeReply>(close);
    EXPECT_NE(client.hash(), hash);
    // By its checksum, in the folder.
    named.mutable_open_volume()->mutable_volume()->set_checksum(volume);
    client.ask<v1::OpenVolumeReply>(named);
    EXPECT_EQ(client.hash(), hash);
  });
}

TEST_F(ResidentEngine, RefusesAVolumeThatDoesNotFitBeforeItIsRead) {
  options.memory_bytes = 400000;
  const auto large = write_volume("large.h5", {70, 60, 50}, made_value);
  run([&](Client& client) {
    opened(client, path);
    const auto error = client.error_of<v1::OpenVolumeReply>(open_command(large));
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ErrorCode::kMemory);
    EXPECT_NE(error->message().find(" MiB on this host, "), std::string::npos) << error->message();
    EXPECT_EQ(client.resident.status().volumes.size(), 1U);
    opened(client, path);
  });
}

TEST_F(ResidentEngine, WorksWithoutFacesOutsideOfTheSurveyAndOnOneVoxel) {
  const auto voxel = write_volume("voxel.h5", {1, 1, 1}, [](const survey::Index&) { return 5.0F; });
  run([&](Client& client) {
    const std::string volume = opened(client, voxel);
    auto replies = client.ask<v1::ExtractReply>(extract_command(volume));
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_EQ(replies[0].done().faces(), 0);
    std::map<FaceIdentity, Face> model;
    const Face through{1, 0, 0, {{{-300, 0, 0}, {300, 20, 0}, {0, 300, 40}}}};
    const Face beyond{1, 0, 1, {{{90000, 0, 0}, {90300, 20, 0}, {90000, 300, 40}}}};
    for (const Face& face : {through, beyond}) model[identity_of(face)] = face;
    client.ask<v1::EditModelReply>(put_command(0, {through, beyond}));
    const Numbers numbers = numbers_of(client.ask<v1::ExtractReply>(extract_command(volume)));
    expect_same(numbers, expected(voxel, model));
    EXPECT_EQ(numbers.at(identity_of(through)).count, 1);
    EXPECT_EQ(numbers.at(identity_of(beyond)).outside, extract::Outside::kWholly);
  });
}

TEST_F(ResidentEngine, ReadsSlipInBetweenTheSlicesOfALongCommand) {
  run([&](Client& client) {
    const std::string volume = opened(client, path);
    std::mt19937 random(9);
    std::vector<Face> faces;
    for (std::int32_t n = 0; n < 3000; ++n) faces.push_back(made_face(random, kDims, 1, n));
    client.ask<v1::EditModelReply>(put_command(1, faces));
    v1::Command read_command;
    read_command.mutable_read_box()->set_volume(
        "0123456789abcdef");  // no such volume: the answer is an error
    const auto read = std::make_shared<CollectingCall<v1::ReadBoxReply>>(read_command);
    const auto extract = std::make_shared<CollectingCall<v1::ExtractReply>>(extract_command(volume));
    bool was_read_first = false;
    extract->on_progress = [&](const Call::State&) {
      if (read->id() == 0) client.queue.push_read(read);
    };
    extract->on_reply = [&] { was_read_first = read->is_over(); };
    client.queue.push(extract);
    EXPECT_EQ(extract->wait().back().done().faces(), 3000);
    EXPECT_TRUE(was_read_first);
    EXPECT_THROW(read->wait(), Error);
    // And are answered while nothing runs.
    const auto another = std::make_shared<CollectingCall<v1::ReadBoxReply>>(read_command);
    client.queue.push_read(another);
    EXPECT_THROW(another->wait(), Error);
  });
}

TEST_F(ResidentEngine, TellsItsStatusAndEndsByShutdown) {
  Resident resident(world, options);
  if (world.rank() != 0) {
    resident.serve(nullptr);
    return;
  }
  CallQueue queue;
  std::thread thread([&] {
    Client client(queue, resident);
    const std::string volume = opened(client, path);
    client.hash();
    const ResidentStatus status = resident.status();
    EXPECT_EQ(status.ranks.size(), static_cast<std::size_t>(world.size()));
    for (const RankFacts& rank : status.ranks) {
      EXPECT_GT(rank.process, 0);
      EXPECT_GT(rank.memory_bytes, 0);
      EXPECT_FALSE(rank.host.empty());
      EXPECT_GE(rank.start_seconds.value_or(-1), 0);
      EXPECT_LT(rank.start_seconds.value_or(0), 100);
    }
    ASSERT_EQ(status.volumes.size(), 1U);
    EXPECT_EQ(status.volumes[0].checksum, volume);
    EXPECT_EQ(status.volumes[0].dims, kDims);
    EXPECT_GE(status.volumes[0].memory_bytes, 23 * 19 * 14 * 4);
    v1::Command command;
    command.mutable_shutdown();
    client.ask<v1::ShutdownReply>(command);
  });
  resident.serve(&queue);
  thread.join();
  EXPECT_THROW(queue.push(std::make_shared<CollectingCall<v1::ShutdownReply>>(v1::Command())), Error);
  // No socket stays behind.
  for (const auto& entry : std::filesystem::directory_iterator(folder)) EXPECT_FALSE(entry.is_socket());
}

}  // namespace
}  // namespace footwall::service
