// Exports hold what was recorded, as programs that share nothing with this one read it; and an export is whole or not
// there at all.
#include <algorithm>
#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <set>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>

#include "core/acquisition/Recording.h"
#include "core/exchange/ExportSource.h"
#include "core/session/Chunk.h"
#include "tests/exchange/ExportSupport.h"
#include "tests/support/Allocations.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> formatNames() {
    std::vector<std::string> names;
    for (const auto* format : exportFormats()) names.emplace_back(format->name);
    return names;
}

Result<ExportReport> exported(const fs::path& session, std::string_view format, const fs::path& out,
                              const ExportWatch& watch = {}) {
    return exportSession(session, *exportFormat(format), out, "0.0.0-test", watch);
}

std::string runPython(const std::string& python, const char* script, const std::vector<fs::path>& arguments) {
    auto command = "'" + python + "' '" + (sourceDir() / "tests/exchange" / script).string() + "'";
    for (const auto& argument : arguments) command += " '" + argument.string() + "'";
    const auto ran = outputOfShell(command);
    return ran.code == 0 ? "" : ran.text.empty() ? "ended by a signal" : ran.text;
}

class Exports : public testing::TestWithParam<std::string> {
protected:
    [[nodiscard]] fs::path out(const std::string& name = "out") const { return folder_.path() / name; }
    /// The folder in which exports are made, and nothing else is.
    [[nodiscard]] fs::path place() const {
        fs::create_directories(folder_.path() / "place");
        return folder_.path() / "place";
    }
    const ScratchDir folder_;
};
INSTANTIATE_TEST_SUITE_P(All, Exports, testing::ValuesIn(formatNames()), [](const auto& one) { return one.param; });

TEST(CsvExport, HoldsWhatPythonReads) {
    RecordProperty("hazard", "H9");
    for (std::uint64_t seed = 1; seed <= trials<std::uint64_t>({.local = 4, .ci = 12, .campaign = 300}); ++seed) {
        const ScratchDir folder;
        const auto drawn = drawSession(folder.path(), seed);
        const auto done = exported(drawn.path, "csv", folder.path() / "out");
        ASSERT_TRUE(done) << done.error().message;
        EXPECT_THAT(done->leftOut, testing::IsEmpty());
        ASSERT_EQ(runPython("python3", "read_csv.py", {folder.path() / "out", folder.path()}), "") << "seed " << seed;
    }
}

TEST(Hdf5Export, HoldsWhatH5pyAndXarrayRead) {
    RecordProperty("hazard", "H9");
    const auto python = pythonWith("hdf5", "h5py, xarray, h5netcdf", "h5py xarray h5netcdf");
    if (!python) GTEST_SKIP() << kNoPackages;
    for (std::uint64_t seed = 1; seed <= trials<std::uint64_t>({.local = 2, .ci = 6, .campaign = 100}); ++seed) {
        const ScratchDir folder;
        const auto drawn = drawSession(folder.path(), seed);
        const auto done = exported(drawn.path, "hdf5", folder.path() / "out.h5");
        ASSERT_TRUE(done) << done.error().message;
        ASSERT_EQ(runPython(*python, "read_hdf5.py", {folder.path() / "out.h5", folder.path()}), "") << "seed " << seed;
    }
}

TEST(BidsExport, HoldsWhatPandasReadsAndTheValidatorAccepts) {
    RecordProperty("hazard", "H9");
    const auto python = pythonWith("bids", "pandas, h5py, bids_validator_deno", "pandas h5py bids-validator-deno");
    if (!python) GTEST_SKIP() << kNoPackages;
    const auto validator = fs::path(*python).parent_path() / "bids-validator-deno";
    std::set<std::string> held, left;
    std::uint64_t gaps = 0, repeated = 0, dropped = 0;
    for (std::uint64_t seed = 1; seed <= trials<std::uint64_t>({.local = 4, .ci = 8, .campaign = 100}); ++seed) {
        const ScratchDir folder;
        const auto drawn = drawSession(folder.path(), seed);
        const auto done = exported(drawn.path, "bids", folder.path() / "out");
        ASSERT_TRUE(done) << done.error().message;
        ASSERT_TRUE(exported(drawn.path, "hdf5", folder.path() / "out.h5"));
        std::ofstream(folder.path() / "report.json") << toJson(*done).dump();
        for (const auto& stream : done->streams) {
            held.insert(stream.name);
            gaps += stream.gaps;
            repeated += stream.repeated;
            dropped += stream.dropped;
        }
        for (const auto& each : done->leftOut) left.insert(each.what);
        std::vector<fs::path> arguments{folder.path() / "out", folder.path(), folder.path() / "out.h5"};
        if (seed == 1) arguments.push_back(validator);
        ASSERT_EQ(runPython(*python, "read_bids.py", arguments), "") << "seed " << seed;
    }
    EXPECT_EQ(held.size(), 6U) << "each stream was there once";
    EXPECT_GT(left.size(), 2U) << "a stream without a grid was left out once";
    EXPECT_TRUE(gaps > 0 && repeated > 0 && dropped > 0) << gaps << ' ' << repeated << ' ' << dropped;
}

TEST(CsvExport, OpensAsARecordingWithTheSamplesOfTheSession) {
    const ScratchDir folder;
    const auto path = folder.path() / "slide.tacto";
    VirtualClock clock;
    auto writer = SessionWriter::create(path, someAbout(), clock);
    ASSERT_TRUE(writer);
    const auto id = (*writer)->addStream(SessionStream{"accelerometer", "acceleration", "m/s2", {"x", "y"}, 2000});
    ASSERT_TRUE(id);
    const auto samples = ramp(0.25, 2000, 4000, 2);
    ASSERT_TRUE((*writer)->append(*id, samples));
    ASSERT_TRUE((*writer)->close());
    ASSERT_TRUE(exported(path, "csv", folder.path() / "out"));
    const auto recording = Recording::open(folder.path() / "out");
    ASSERT_TRUE(recording) << recording.error().message;
    const auto* stream = recording->find(StreamKind::Acceleration);
    ASSERT_NE(stream, nullptr);
    EXPECT_THAT(stream->samples.t_s, testing::Pointwise(testing::DoubleNear(kStampTolerance_s), samples.t_s));
    EXPECT_EQ(stream->samples.values, samples.values);
    EXPECT_EQ(stream->info.unit, StreamUnit::MetrePerSecondSquared);
}

TEST_P(Exports, AreTheSameBytesTwice) {
    const auto drawn = drawSession(folder_.path(), 11);
    const auto first = exported(drawn.path, GetParam(), out("a")), second = exported(drawn.path, GetParam(), out("b"));
    ASSERT_TRUE(first && second) << (first ? second : first).error().message;
    EXPECT_EQ(bytesBelow(out("a")), bytesBelow(out("b")));
    ASSERT_EQ(first->files.size(), second->files.size());
    for (std::size_t i = 0; i < first->files.size(); ++i) EXPECT_EQ(first->files[i].sha256, second->files[i].sha256);
    const auto& file = first->files.front();
    const auto where = fs::is_directory(out("a")) ? out("a") / file.path : out("a");
    EXPECT_EQ(outputOfShell("sha256sum '" + where.string() + "'").text.substr(0, 64), file.sha256);
}

TEST_P(Exports, RefuseATakenNameAndLeaveItAsItIs) {
    const auto drawn = drawSession(folder_.path(), 12);
    fs::create_directory(out("folder"));
    std::ofstream(out("file")) << "mine";
    fs::create_symlink("nowhere", out("link"));
    for (const char* taken : {"folder", "file", "link"}) {
        const auto done = exported(drawn.path, GetParam(), out(taken));
        ASSERT_FALSE(done) << taken;
        EXPECT_EQ(done.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(done.error().message, HasSubstr("exists already"));
    }
    EXPECT_TRUE(fs::is_empty(out("folder")));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(std::ifstream(out("file")).rdbuf()), {}), "mine");
    EXPECT_TRUE(fs::is_symlink(out("link")));
}

TEST_P(Exports, RefuseANameThatAppearsMeanwhile) {
    const auto drawn = drawSession(folder_.path(), 13);
    const auto target = place() / "out";
    const auto done = exported(drawn.path, GetParam(), target, {.stopped = [&] {
                                   fs::create_directories(target);
                                   return false;
                               }});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::InvalidArgument);
    EXPECT_THAT(namesIn(place()), ElementsAre("out"));
    EXPECT_TRUE(fs::is_empty(target));
}

TEST_P(Exports, LeaveNothingWhenCancelledAtAnyMoment) {
    const auto drawn = drawSession(folder_.path(), 14);
    int asked = 0;
    double share = 0;
    ASSERT_TRUE(exported(drawn.path, GetParam(), out(),
                         {.stopped = [&] { return ++asked < 0; },
                          .progress =
                              [&](double now) {
                                  EXPECT_GE(now, share);
                                  share = now;
                              }}));
    EXPECT_EQ(share, 1);
    std::mt19937 random(3);
    for (int trial = 0; trial < trials<int>({.local = 20, .ci = 100, .campaign = 1000}); ++trial) {
        int left = static_cast<int>(random() % static_cast<unsigned>(asked));
        const auto done = exported(drawn.path, GetParam(), place() / "out", {.stopped = [&] { return --left < 0; }});
        ASSERT_FALSE(done);
        EXPECT_EQ(done.error().code, ErrorCode::Stopped);
        ASSERT_THAT(namesIn(place()), ElementsAre());
    }
}

TEST(ExportSource, ReadsNoCommandAfterItWasCancelled) {
    if (!countsAllocations()) GTEST_SKIP() << kNotCounted;
    const ScratchDir folder;
    const auto path = folder.path() / "s.tacto";
    VirtualClock clock;
    auto writer = SessionWriter::create(path, someAbout(), clock).value();
    constexpr std::size_t kTrains = 2000;
    for (std::size_t i = 0; i < kTrains; ++i)
        ASSERT_TRUE(writer->command(clock.now(), "delivered", {{"amplitude_v", 10.0}, {"interval_s", 0.5}}));
    ASSERT_TRUE(writer->close());
    bool stop = false;
    const auto source = ExportSource::open(path, nullptr, {.stopped = [&] { return stop; }}, "0.0.0-test");
    ASSERT_TRUE(source) << source.error().message;
    const auto cancelled = [&](auto read) {
        stop = false;
        const auto before = allocationsOfThisThread();
        const auto done = read([&](const auto&) -> Result<void> {
            stop = true;
            return {};
        });
        EXPECT_EQ(done ? ErrorCode::Io : done.error().code, ErrorCode::Stopped);
        EXPECT_LT(allocationsOfThisThread() - before, kTrains);
    };
    cancelled([&](const auto& visit) { return source->forEachTrain(visit); });
    cancelled([&](const auto& visit) { return source->forEachMoment(visit); });
}

TEST_P(Exports, LeaveNothingOnAFullDisk) {
    const auto drawn = drawSession(folder_.path(), 15);
    ASSERT_TRUE(exported(drawn.path, GetParam(), out()));
    std::uintmax_t largest = 0;
    if (fs::is_directory(out())) {
        for (const auto& each : fs::recursive_directory_iterator(out()))
            if (each.is_regular_file()) largest = std::max(largest, each.file_size());
    } else {
        largest = fs::file_size(out());
    }
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    std::mt19937_64 random(4);
    for (int trial = 0; trial < trials<int>({.local = 15, .ci = 60, .campaign = 500}); ++trial) {
        auto now = before;
        now.rlim_cur = random() % largest;
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &now), 0);
        const auto done = exported(drawn.path, GetParam(), place() / "out");
        setrlimit(RLIMIT_FSIZE, &before);
        ASSERT_FALSE(done) << now.rlim_cur << " of " << largest;
        EXPECT_EQ(done.error().code, ErrorCode::Io);
        EXPECT_THAT(done.error().message, HasSubstr("File too large"));
        EXPECT_THAT(done.error().message, testing::Not(HasSubstr("/.")));
        ASSERT_THAT(namesIn(place()), ElementsAre());
    }
    // The library of the format is as good as before.
    const auto again = exported(drawn.path, GetParam(), place() / "out");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(bytesBelow(place() / "out"), bytesBelow(out()));
}

TEST_P(Exports, LeaveNoTargetWhenKilled) {
    const auto drawn = drawSession(folder_.path(), 16);
    const auto begun = std::chrono::steady_clock::now();
    ASSERT_TRUE(exported(drawn.path, GetParam(), out()));
    const auto whole = std::chrono::steady_clock::now() - begun;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0, 1.2);
    int killed = 0;
    for (int trial = 0; trial < trials<int>({.local = 10, .ci = 100, .campaign = 1000}); ++trial) {
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0) _exit(exported(drawn.path, GetParam(), place() / "out") ? 0 : 1);
        std::this_thread::sleep_for(whole * share(random));
        kill(child, SIGKILL);
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        killed += WIFSIGNALED(status) ? 1 : 0;
        if (fs::exists(place() / "out")) {
            EXPECT_EQ(bytesBelow(place() / "out"), bytesBelow(out()));
        }
        for (const auto& name : namesIn(place())) {
            if (name != "out") EXPECT_TRUE(name.starts_with(".out.") && name.size() == 11) << name;
            fs::remove_all(place() / name);
        }
    }
    EXPECT_GT(killed, 0);
}

TEST_P(Exports, SayWhatIsMissingOfADamagedSession) {
    RecordProperty("hazard", "H8");
    const auto drawn = drawSession(folder_.path(), 17);
    forge(drawn.path,
          "UPDATE chunks SET data=zeroblob(length(data)) WHERE seq=(SELECT max(seq) FROM chunks WHERE "
          "stream=1); UPDATE entries SET body='{' WHERE kind='event' AND name LIKE 'armed%'");
    const auto done = exported(drawn.path, GetParam(), out());
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_TRUE(done->damaged);
    EXPECT_THAT(done->marks, testing::Contains("damaged"));
    EXPECT_THAT(done->problems, testing::Not(testing::IsEmpty()));
    ASSERT_FALSE(done->streams.empty());
    for (const auto& stream : drawn.expected["streams"]) {
        const auto name = stream["name"].get<std::string>();
        const auto samples = stream["samples"].get<std::uint64_t>();
        const auto written = std::ranges::find(done->streams, name, &ExportedStream::name);
        if (written == done->streams.end())
            EXPECT_TRUE(std::ranges::count(done->leftOut, name, &LeftOut::what) == 1) << name;
        else if (name == "acceleration")
            EXPECT_LT(written->samples, samples);
        else
            EXPECT_EQ(written->samples, samples) << name;
    }
}

TEST_P(Exports, LeaveOutACaptureWhoseDescriptionIsDamaged) {
    RecordProperty("hazard", "H8");
    for (const char* change : {"'$.rate_hz', -1.0", "'$.rate_hz', 0.0", "'$.start_s', NULL"}) {
        const ScratchDir folder;
        const auto drawn = drawSession(folder.path(), 18);
        forge(drawn.path, fmt::format("UPDATE entries SET body=json_set(body, {}) WHERE seq=(SELECT min(seq) FROM "
                                      "captures)",
                                      change));
        const auto done = exported(drawn.path, GetParam(), folder.path() / "out");
        ASSERT_TRUE(done) << change << ": " << done.error().message;
        EXPECT_TRUE(done->damaged) << change;
        const auto source = ExportSource::open(drawn.path, nullptr, {}, "0.0.0-test");
        ASSERT_TRUE(source);
        for (const auto& each : source->captures()) {
            const bool first = each.seq == source->captures().front().seq;
            EXPECT_EQ(source->capture(each).value().has_value(), !first) << change;
        }
    }
}

/// Writes a session whose members, streams, channels and captures have names that formats need for something else.
fs::path writeSessionOfHardNames(const fs::path& folder) {
    const auto path = folder / "names.tacto";
    VirtualClock clock;
    auto about = someAbout();
    about.devices = {{"pulsepal:/dev/ttyACM0", "stimulator", "Pulse Pal", "1", "1", false},
                     {"sim:sensor", "sensor", "Simulated sensor", "2", "1", true}};
    auto session = SessionWriter::create(path, about, clock).value();
    for (const char* kind : {"force", "force", "force-2", "trials"}) {
        const auto id = session->addStream(SessionStream{kind, kind, "N", {"force"}, 100});
        EXPECT_TRUE(session->append(*id, ramp(0, 100, 50, 1)));
    }
    const auto id = session->addStream(SessionStream{"frames", "frames", "", {"time", "a/b", "a_b", "a_b~2"}, 100});
    EXPECT_TRUE(session->append(*id, ramp(0, 100, 50, 4)));
    EXPECT_TRUE(session->command(clock.now(), "train", {{"amplitude_v", 10.0}}));
    EXPECT_TRUE(session->command(clock.now(), "delivered", {{"amplitude_v", 10.0}}));
    EXPECT_TRUE(session->event(clock.now(), "armed", {{"load", "1 kohm"}}));
    const auto trial = session->trial(clock.now(), "rough",
                                      {{"time", 1},
                                       {"a/b", 2},
                                       {"a_b", 3},
                                       {"measured_trial", 4},
                                       {"trial", 5},
                                       {"simulated", 6},
                                       {"captures", {7, 7}}});
    Capture capture;
    capture.rate_hz = 1e6;
    capture.channels = {{"time", "V", {1, 2}, -50, 50, 0.4, 0.01, 0.2}, {"a/b", "V", {1, 2}, -50, 50, 0.4, 0.01, 0.2}};
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(session->capture(clock.now(), capture, *trial));
    EXPECT_TRUE(session->close());
    return path;
}

TEST_P(Exports, KeepWhateverItIsCalled) {
    const auto path = writeSessionOfHardNames(folder_.path());
    const auto done = exported(path, GetParam(), out());
    ASSERT_TRUE(done) << done.error().message;
    std::set<std::string> files;
    for (const auto& file : done->files) EXPECT_TRUE(files.insert(file.path).second) << file.path;
}

TEST(ExportSource, GivesEachThingANameOfItsOwn) {
    const ScratchDir folder;
    const auto source = ExportSource::open(writeSessionOfHardNames(folder.path()), nullptr, {}, "0.0.0-test");
    ASSERT_TRUE(source) << source.error().message;
    std::vector<std::string> streams;
    for (const auto& stream : source->streams()) streams.push_back(stream.name);
    EXPECT_THAT(streams, ElementsAre("force", "force-2", "force-2-2", "trials-2", "frames"));
    ASSERT_EQ(source->captures().size(), 2U);
    EXPECT_NE(source->captures()[0].name, source->captures()[1].name);
    std::map<std::string, double> cells;
    const auto& columns = source->trials().columns;
    ASSERT_TRUE(source->forEachRow(source->trials(), [&](std::span<const ExportCell> row) -> Result<void> {
        for (std::size_t c = 0; c < row.size(); ++c) {
            const auto* number = std::get_if<double>(&row[c]);
            EXPECT_TRUE(cells.emplace(columns[c].at, number == nullptr ? kNaN : *number).second) << columns[c].at;
        }
        return {};
    }));
    // Each value is there once, whatever its column is called.
    for (const int value : {2, 3, 4, 5, 6}) {
        EXPECT_EQ(std::ranges::count_if(cells, [&](const auto& cell) { return cell.second == value; }), 1) << value;
    }
    EXPECT_EQ(cells.at("measured_time"), 1);
    EXPECT_EQ(cells.at("trial"), 1);
}

TEST(ExportSource, SaysOfATableWhatItsRowsSay) {
    RecordProperty("hazard", "H9");
    const ScratchDir folder;
    const auto source = ExportSource::open(writeSessionOfHardNames(folder.path()), nullptr, {}, "0.0.0-test");
    ASSERT_TRUE(source) << source.error().message;
    for (const auto* table : source->tables()) {
        std::size_t rows = 0;
        ASSERT_TRUE(source->forEachRow(*table, [&](std::span<const ExportCell> row) -> Result<void> {
            ++rows;
            EXPECT_EQ(std::get<double>(row.back()), source->simulated(*table) ? 1 : 0) << table->name;
            return {};
        }));
        EXPECT_TRUE(rows > 0 || table == &source->records()) << table->name;
    }
    EXPECT_FALSE(source->simulated(source->trains()));
    EXPECT_TRUE(source->simulated(source->events()));
}

TEST_P(Exports, MarkASessionThatWasNotClosed) {
    RecordProperty("hazard", "H8");
    const auto path = folder_.path() / "crashed.tacto";
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        VirtualClock clock;
        auto writer = SessionWriter::create(path, someAbout(), clock);
        const auto id = (*writer)->addStream(SessionStream{"force", "force", "N", {"force"}, 100});
        const bool kept = (*writer)->append(*id, ramp(0, 100, 500, 1)) && (*writer)->flush();
        _exit(kept ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0);
    const auto done = exported(path, GetParam(), out());
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_FALSE(done->damaged);
    EXPECT_THAT(done->marks, testing::Contains("ended without closing"));
    ASSERT_EQ(done->streams.size(), 1U);
    EXPECT_EQ(done->streams[0].samples, 500U);
}

TEST(ExportTarget, HasAPrivateNameThatFits) {
    const ScratchDir folder;
    std::string longest;
    while (longest.size() + 2 <= 254) longest += "é";
    longest += "x";
    auto target = ExportTarget::begin(folder.path() / longest, ExportTarget::Kind::Folder);
    ASSERT_TRUE(target) << target.error().message;
    EXPECT_LE(target->draft().filename().string().size(), 255U);
    ASSERT_TRUE(target->publish());
    EXPECT_THAT(namesIn(folder.path()), ElementsAre(longest));
}

TEST(ExportTarget, SaysWhyItCannotBeMade) {
    const ScratchDir folder;
    for (const char* nothing : {"", "/", ".", ".."}) {
        const auto target = ExportTarget::begin(nothing, ExportTarget::Kind::Folder);
        ASSERT_FALSE(target) << nothing;
        EXPECT_EQ(target.error().code, ErrorCode::InvalidArgument);
    }
    const auto target = ExportTarget::begin(folder.path() / "none" / "out", ExportTarget::Kind::File);
    ASSERT_FALSE(target);
    EXPECT_EQ(target.error().code, ErrorCode::Io);
    EXPECT_THAT(target.error().message, HasSubstr("none/out could not be written: No such file"));
}

}  // namespace
}  // namespace tacto::test
