#include <cmath>
#include <cstring>

#include "core/session/Digest.h"
#include "tests/session/SessionSupport.h"

namespace tacto {
namespace {

using test::ScratchDir;

TEST(Session, GivesBackWhatWasUsed) {
    const ScratchDir dir;
    const auto path = dir.path() / "a session with #?% in its name.tacto";
    test::writeSession(path);
    const auto reader = SessionReader::open(path);
    ASSERT_TRUE(reader) << reader.error().message;
    const auto& about = reader->about();
    const auto wanted = test::someAbout();
    EXPECT_EQ(about.programVersion, wanted.programVersion);
    EXPECT_EQ(about.protocol, wanted.protocol);
    EXPECT_EQ(about.protocolSha256, wanted.protocolSha256);
    EXPECT_EQ(about.parameters, wanted.parameters);
    EXPECT_EQ(about.seed, 1U);
    EXPECT_EQ(about.devices, wanted.devices);
    EXPECT_EQ(about.profileJson, wanted.profileJson);
    EXPECT_EQ(about.profileSha256, sha256Hex(wanted.profileJson));
    EXPECT_EQ(about.limitSets, wanted.limitSets);
    EXPECT_TRUE(about.simulated);
    EXPECT_EQ(about.mode, "bench load");
    EXPECT_EQ(about.wallStart, wanted.wallStart);
    EXPECT_EQ(about.wallStartAt, wanted.wallStartAt);
    EXPECT_TRUE(about.virtualClock);
    EXPECT_TRUE(reader->closed());
}

TEST(Session, KeepsSeedsThatADoubleCannotHold) {
    const ScratchDir dir;
    test::writeSession(dir.path() / "s.tacto", 18'446'744'073'709'551'615U);
    EXPECT_EQ(SessionReader::open(dir.path() / "s.tacto")->about().seed, 18'446'744'073'709'551'615U);
}

TEST(Session, GivesBackRowsOfEveryKindInOrder) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    test::writeSession(path);
    const auto reader = SessionReader::open(path);
    ASSERT_TRUE(reader);

    const auto events = reader->events().value();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].name, "armed");
    EXPECT_EQ(events[0].body["load"], "1 kohm");

    const auto commands = reader->commands().value();
    ASSERT_EQ(commands.size(), 30U);
    EXPECT_EQ(commands[13].name, "train");
    EXPECT_EQ(commands[13].body["amplitude_v"], 13);
    EXPECT_EQ(commands[13].at, toInstant(1.3));

    const auto trials = reader->trials().value();
    ASSERT_EQ(trials.size(), 3U);
    EXPECT_EQ(trials[1].number, 2);
    EXPECT_EQ(trials[1].condition, "smooth-low");
    EXPECT_EQ(trials[2].measured["interval_s"], 0.5);
    EXPECT_EQ(trials[2].at, toInstant(2.9));

    const auto measurements = reader->measurements().value();
    ASSERT_EQ(measurements.size(), 1U);
    EXPECT_EQ(measurements[0].body["ohm"], 1001.5);

    const auto items = reader->reportItems().value();
    ASSERT_EQ(items.size(), 2U);
    EXPECT_EQ(items[0].body["text"], "Four conditions");
    EXPECT_EQ(items[1].body["columns"], nlohmann::json({"a", "b"}));

    const auto log = reader->log().value();
    ASSERT_EQ(log.size(), 1U);
    EXPECT_EQ(log[0].name, "info");
    EXPECT_EQ(log[0].body["text"], "all \"done\"\nwith µ");

    const auto verdicts = reader->verdicts().value();
    ASSERT_EQ(verdicts.size(), 1U);
    EXPECT_EQ(verdicts[0].subject, "separability");
    EXPECT_EQ(verdicts[0].verdict, "pass");
    EXPECT_EQ(verdicts[0].reasons, std::vector<std::string>{"every pair apart"});
    EXPECT_EQ(verdicts[0].results["accuracy"], 1.0);
    EXPECT_LT(trials[2].seq, verdicts[0].seq);
}

TEST(Session, GivesBackCapturesBitByBit) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    test::writeSession(path);
    const auto reader = SessionReader::open(path);
    ASSERT_TRUE(reader);
    const auto captures = reader->captures().value();
    ASSERT_EQ(captures.size(), 3U);
    EXPECT_EQ(captures[1].trial, 2);
    EXPECT_EQ(captures[1].samples, 2000U);
    EXPECT_EQ(captures[1].channels, (std::vector<std::string>{"voltage", "current"}));
    const auto capture = reader->capture(captures[1].seq);
    ASSERT_TRUE(capture) << capture.error().message;
    EXPECT_EQ(capture->rate_hz, 1e6);
    EXPECT_EQ(capture->start_s, 1);
    EXPECT_EQ(capture->trigger_s, 1.001);
    EXPECT_TRUE(capture->simulated);
    ASSERT_EQ(capture->channels.size(), 2U);
    EXPECT_EQ(capture->channels[0].unit, "V");
    EXPECT_EQ(capture->channels[0].lsb, 0.4);
    EXPECT_EQ(capture->channels[0].offsetTolerance, 0.2);
    EXPECT_EQ(capture->channels[0].samples[1], static_cast<float>(40.4));
    EXPECT_TRUE(std::signbit(capture->channels[1].samples[100])) << "-0 stays -0";
    EXPECT_TRUE(std::isnan(reader->capture(captures[2].seq)->trigger_s)) << "a record without a trigger";
    EXPECT_EQ(reader->capture(1).error().code, ErrorCode::NotFound);
}

TEST(Session, KeepsCapturesThatDoNotCompress) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    VirtualClock clock;
    Capture capture;
    capture.channels = {{"voltage", "V", {}, 0, 0, 0, 0, 0}};
    std::uint32_t state = 1;
    for (int i = 0; i < 5000; ++i) {
        state = state * 1'664'525U + 1'013'904'223U;
        float value = 0;
        std::memcpy(&value, &state, sizeof value);
        capture.channels[0].samples.push_back(value);
    }
    Capture silent;  // a capture without channels
    {
        auto writer = SessionWriter::create(path, {}, clock).value();
        ASSERT_TRUE(writer->capture(clock.now(), capture));
        ASSERT_TRUE(writer->capture(clock.now(), silent));
    }
    const auto reader = SessionReader::open(path);
    const auto captures = reader->captures().value();
    const auto back = reader->capture(captures[0].seq);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(std::memcmp(back->channels[0].samples.data(), capture.channels[0].samples.data(), 5000 * sizeof(float)),
              0);
    EXPECT_EQ(reader->capture(captures[1].seq)->samples(), 0U);
    EXPECT_EQ(verifySession(path)->status, SessionStatus::Intact);
}

TEST(Session, SameSeedGivesTheSameRowsAndStreams) {
    const ScratchDir dir;
    test::writeSession(dir.path() / "one.tacto");
    test::writeSession(dir.path() / "two.tacto");
    test::writeSession(dir.path() / "other.tacto", 2);
    const auto one = SessionReader::open(dir.path() / "one.tacto")->reproducibleText().value();
    EXPECT_EQ(one, SessionReader::open(dir.path() / "two.tacto")->reproducibleText().value());
    EXPECT_NE(one, SessionReader::open(dir.path() / "other.tacto")->reproducibleText().value());
    EXPECT_EQ(one.find("2026-11-20"), std::string::npos) << "wall time is not part of it";
    EXPECT_NE(one.find("rough-high"), std::string::npos);
}

TEST(Session, RefusesToOverwrite) {
    const ScratchDir dir;
    VirtualClock clock;
    const auto path = dir.write("notes.txt", "keep me");
    const auto writer = SessionWriter::create(path, {}, clock);
    ASSERT_FALSE(writer);
    EXPECT_EQ(writer.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(writer.error().message.find("notes.txt"), std::string::npos);
    EXPECT_EQ(test::bytesOf(path).size(), 7U);
    dir.write("s.tacto-wal", "a journal without its session");
    EXPECT_FALSE(SessionWriter::create(dir.path() / "s.tacto", {}, clock));
}

TEST(Session, SaysWhyAFileCannotBeMade) {
    VirtualClock clock;
    const auto writer = SessionWriter::create("/nowhere/at/all/s.tacto", {}, clock);
    ASSERT_FALSE(writer);
    EXPECT_EQ(writer.error().code, ErrorCode::Io);
    EXPECT_NE(writer.error().message.find("/nowhere/at/all/s.tacto"), std::string::npos);
}

TEST(Session, RefusesWhatDoesNotFit) {
    const ScratchDir dir;
    VirtualClock clock;
    auto writer = SessionWriter::create(dir.path() / "s.tacto", {}, clock).value();
    EXPECT_EQ(writer->addStream(SessionStream{"empty", "", "", {}, 0}).error().code, ErrorCode::InvalidArgument);
    const int stream = writer->addStream(SessionStream{"two", "", "", {"a", "b"}, 0}).value();
    EXPECT_EQ(writer->append(stream + 1, {}).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(writer->append(0, {}).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(writer->append(stream, test::ramp(0, 1, 2, 1)).error().code, ErrorCode::InvalidArgument);
    Capture capture;
    capture.channels = {{"voltage", "V", {1, 2}, 0, 0, 0, 0, 0}, {"current", "A", {1}, 0, 0, 0, 0, 0}};
    EXPECT_EQ(writer->capture(clock.now(), capture).error().code, ErrorCode::InvalidArgument);
    capture.channels.pop_back();
    EXPECT_EQ(writer->capture(clock.now(), capture, 1).error().code, ErrorCode::InvalidArgument) << "no trial yet";
    EXPECT_FALSE(writer->failed()) << "a caller's mistake does not end the recording";
    ASSERT_TRUE(writer->close());
    EXPECT_EQ(writer->event(clock.now(), "late", {}).error().code, ErrorCode::InvalidArgument);
    EXPECT_TRUE(writer->close()) << "closing twice is harmless";
    EXPECT_EQ(verifySession(dir.path() / "s.tacto")->status, SessionStatus::Intact);
}

TEST(Session, KeepsTextThatIsNotUtf8AndNumbersThatAreNotFinite) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    VirtualClock clock;
    {
        auto writer = SessionWriter::create(path, {}, clock).value();
        ASSERT_TRUE(writer->event(clock.now(), "garbage \xff\xfe", {{"reply", "\xff\x00"}, {"z_ohm", std::nan("")}}));
        ASSERT_TRUE(writer->log(clock.now(), "warning", std::string_view("a\0b", 3)));
    }
    const auto reader = SessionReader::open(path);
    const auto events = reader->events();
    ASSERT_TRUE(events) << events.error().message;
    EXPECT_TRUE((*events)[0].body["z_ohm"].is_null());
    EXPECT_EQ(reader->log().value()[0].body["text"], std::string("a\0b", 3));
    EXPECT_EQ(verifySession(path)->status, SessionStatus::Intact);
}

TEST(Session, OffersViewsToOtherPrograms) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    test::writeSession(path);
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
    const auto number = [&](const char* sql) {
        sqlite3_stmt* row = nullptr;
        EXPECT_EQ(sqlite3_prepare_v2(database, sql, -1, &row, nullptr), SQLITE_OK) << sql << sqlite3_errmsg(database);
        EXPECT_EQ(sqlite3_step(row), SQLITE_ROW) << sql;
        const double value = sqlite3_column_double(row, 0);
        sqlite3_finalize(row);
        return value;
    };
    EXPECT_EQ(number("SELECT count(*) FROM trials WHERE condition='rough-high'"), 2);
    EXPECT_EQ(number("SELECT json_extract(measured, '$.amplitude_v') FROM trials WHERE number=2"), 39.9);
    EXPECT_EQ(number("SELECT count(*) FROM commands"), 30);
    EXPECT_EQ(number("SELECT t_s FROM events"), 0);
    EXPECT_EQ(number("SELECT count(*) FROM verdicts WHERE verdict='pass'"), 1);
    EXPECT_EQ(number("SELECT stream FROM streams WHERE name='roughness frames'"), 2);
    EXPECT_EQ(number("SELECT count(*) FROM log"), 1);
    EXPECT_EQ(number("SELECT count(*) FROM measurements"), 1);
    sqlite3_close(database);
}

TEST(Session, CanBeReadWhileItIsWritten) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    VirtualClock clock;
    auto writer = SessionWriter::create(path, {}, clock).value();
    ASSERT_TRUE(writer->trial(clock.now(), "first", {}));
    const auto reader = SessionReader::open(path);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_FALSE(reader->closed());
    EXPECT_EQ(reader->trials()->size(), 1U);
    EXPECT_EQ(reader->chainHead(), writer->chainHead());
    ASSERT_TRUE(writer->trial(clock.now(), "second", {}));
    EXPECT_EQ(reader->trials()->size(), 2U);
    ASSERT_TRUE(writer->close());
    EXPECT_EQ(verifySession(path)->status, SessionStatus::Intact);
}

class Heard final : public SessionListener {
public:
    void onStream(int id, const SessionStream& stream) noexcept override { streams.emplace_back(id, stream.name); }
    void onSamples(int stream, const SampleBlock& block) noexcept override {
        samples.emplace_back(stream, block.values);
    }
    void onCommand(const SessionRow& command) noexcept override { rows.push_back(command); }
    void onEvent(const SessionRow& event) noexcept override { rows.push_back(event); }
    void onTrial(const SessionTrial& trial) noexcept override { trials.push_back(trial); }
    std::vector<std::pair<int, std::string>> streams;
    std::vector<std::pair<int, std::vector<double>>> samples;
    std::vector<SessionRow> rows;
    std::vector<SessionTrial> trials;
};

TEST(SessionListener, HearsWhatTheSessionTookAndNothingElse) {
    const ScratchDir dir;
    const auto path = dir.path() / "s.tacto";
    VirtualClock clock;
    auto writer = SessionWriter::create(path, test::someAbout(), clock).value();
    ASSERT_TRUE(writer->event(Instant(1), "before", {}));
    const auto heard = std::make_shared<Heard>();
    writer->listen(heard);
    const int stream = writer->addStream(SessionStream{"a", "frames", "", {"x", "y"}, 0}).value();
    ASSERT_TRUE(writer->append(stream, {{1.0, 2.0}, {1, 2, 3, std::nan("")}}));
    EXPECT_FALSE(writer->append(stream, {{3.0}, {1}}));
    EXPECT_FALSE(writer->append(stream + 1, {{3.0}, {1, 2}}));
    ASSERT_TRUE(writer->command(Instant(2), "train", {{"amplitude_v", 12.5}}));
    ASSERT_TRUE(writer->event(Instant(3), "refused", {{"text", "too much"}}));
    ASSERT_TRUE(writer->trial(Instant(4), "rough", {{"n", 1}}));
    writer->listen(nullptr);
    EXPECT_EQ(heard.use_count(), 1);
    ASSERT_TRUE(writer->event(Instant(5), "after", {}));
    ASSERT_TRUE(writer->close());

    EXPECT_EQ(heard->streams, (std::vector<std::pair<int, std::string>>{{stream, "a"}}));
    ASSERT_EQ(heard->samples.size(), 1U);
    EXPECT_EQ(heard->samples[0].second.size(), 4U);
    const auto reader = SessionReader::open(path).value();
    const auto events = reader.events().value();
    const auto commands = reader.commands().value();
    ASSERT_EQ(heard->rows.size(), 2U);
    for (const auto& [row, stored] : {std::pair{heard->rows[0], commands.at(0)}, {heard->rows[1], events.at(1)}}) {
        EXPECT_EQ(row.seq, stored.seq);
        EXPECT_EQ(row.at, stored.at);
        EXPECT_EQ(row.name, stored.name);
        EXPECT_EQ(row.body, stored.body);
    }
    ASSERT_EQ(heard->trials.size(), 1U);
    EXPECT_EQ(heard->trials[0].number, 1);
    EXPECT_EQ(heard->trials[0].condition, "rough");
}

}  // namespace
}  // namespace tacto
