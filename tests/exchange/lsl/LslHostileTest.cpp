// A library or a network that hangs, refuses, floods or sends anything delays no train and no stop, and loses nothing
// in silence. The library is HostileLsl.cpp.
#include <dlfcn.h>
#include <nlohmann/json.hpp>

#include "core/base/Printable.h"
#include "core/exchange/lsl/LslStreams.h"
#include "core/session/SessionReader.h"
#include "tests/bench/BenchFixture.h"
#include "tests/support/Comes.h"
#include "tests/support/InTime.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;
using test::comes;
using test::refused;
using testing::HasSubstr;

class HostileLsl : public test::BenchFixture {
protected:
    HostileLsl() { ::setenv("TACTOSCOPE_LSL", TACTO_HOSTILE_LSL, 1); }
    ~HostileLsl() override {
        does("nothing");
        ::unsetenv("TACTOSCOPE_LSL");
    }
    template <class Function>
    static Function* function(const char* name) {
        static void* const library = dlopen(TACTO_HOSTILE_LSL, RTLD_NOW);
        return reinterpret_cast<Function*>(dlsym(library, name));
    }
    static void does(const char* what) { function<void(const char*)>("lslTestDoes")(what); }

    /// Opens a bench in real time whose session is heard by LSL; not armed.
    Result<void> openHeard(const LslOrder& order, bool markersOnly = false) {
        about_.simulated = true;
        about_.devices = {{"sim:", std::string(nameOf(Role::Stimulator)), "twin", "", "", true}};
        writer_ = SessionWriter::create(path_, about_, sessionClock_).value();
        auto made = LslStreams::prepare(order, markersOnly);
        if (!made) return failure(made);
        lsl_ = std::move(*made);
        writer_->listen(lsl_);
        session_ = writer_.get();
        open({}, {Role::Stimulator, Role::Sensor}, true);
        return lsl_->begin(*writer_, about_, "session", clock_);
    }
    LslTally end() {
        bench_.reset();
        writer_->listen(nullptr);
        const auto tally = lsl_->end();
        EXPECT_TRUE(writer_->close());
        return tally;
    }
    std::vector<nlohmann::json> marks() const {
        std::vector<nlohmann::json> bodies;
        const auto reader = SessionReader::open(path_).value();
        const auto events = reader.events().value();
        for (const auto& event : events)
            if (event.name == kOperatorMarkEvent) bodies.push_back(event.body);
        return bodies;
    }
    static int created() { return function<int()>("lslTestCreated")(); }
    static int looked() { return function<int()>("lslTestLooked")(); }
    static int given() { return function<int()>("lslTestGiven")(); }

    const test::ScratchDir folder_;
    const std::filesystem::path path_ = folder_.path() / "s.tacto";
    SteadyClock sessionClock_;
    SessionAbout about_;
    std::unique_ptr<SessionWriter> writer_;
    std::shared_ptr<LslStreams> lsl_;
};

TEST_F(HostileLsl, TrainsAndStopsAreAsWithoutItWhileTheLibraryHangs) {
    RecordProperty("hazard", "H2");
    for (const char* what : {"hangs while sending", "hangs while looking", "hangs while taking", "hangs at the end"}) {
        SCOPED_TRACE(what);
        std::filesystem::remove(path_);
        does(what);
        ASSERT_TRUE(openHeard({true, "Task"}));
        ASSERT_IN_TIME(armAndDrive(1, 1));
        EXPECT_IN_TIME(comes([&] { return bench_->telemetry().trainsDelivered >= 3; }, 20s));
        const auto before = bench_->telemetry();
        EXPECT_EQ(before.trainsRefused + before.trainsSkipped, 0U);
        const auto asked = std::chrono::steady_clock::now();
        bench_->stop("the test");
        EXPECT_IN_TIME(std::chrono::steady_clock::now() - asked < 100ms);
        EXPECT_NE(state(), InterlockState::Delivering);
        const auto ending = std::chrono::steady_clock::now();
        const auto tally = end();
        EXPECT_TRUE(tally.hung);
        EXPECT_THAT(lslSentence(tally), HasSubstr("did not return"));
        EXPECT_IN_TIME(std::chrono::steady_clock::now() - ending < 6s);
        does("nothing");  // lets the thread that was left go
        lsl_.reset();
        writer_.reset();
    }
}

TEST_F(HostileLsl, WhatRefusesBeginsNothing) {
    RecordProperty("hazard", "H2");
    const std::pair<const char*, const char*> wrong[] = {
        {"refuses", "refuses the stream Tactoscope-markers (no network)"},
        {"refuses the outlet", "no network"},
        {"has no clock", "says no number"},
        {"hangs at the start", "within 5 s"}};
    for (const auto& [what, says] : wrong) {
        SCOPED_TRACE(what);
        std::filesystem::remove(path_);
        does(what);
        const auto begun = openHeard({true, ""});
        ASSERT_FALSE(begun);
        EXPECT_THAT(begun.error().message, HasSubstr(says));
        does("nothing");
        static_cast<void>(end());
    }
    does("is old");
    EXPECT_THAT(LslStreams::prepare({true, ""}, false).error().message, HasSubstr("liblsl 1.12; 1.13 or newer"));
}

TEST_F(HostileLsl, WhatIsNoLiblslIsRefusedByName) {
    for (const auto& [file, says] :
         {std::pair{"/nowhere/liblsl.so", "\"/nowhere/liblsl.so\""}, {"libz.so.1", "libz.so.1 has no function"}}) {
        ::setenv("TACTOSCOPE_LSL", file, 1);
        const auto made = LslStreams::prepare({true, ""}, false);
        ASSERT_FALSE(made);
        EXPECT_THAT(made.error().message, HasSubstr(says));
        EXPECT_THAT(made.error().message, HasSubstr("liblsl 1.13"));
    }
    for (const char* name : {"", "a'b", "a\"b", "\x1b[2J", "Tactoscope-markers"})
        EXPECT_FALSE(LslNotes::checkName(name)) << name;
    EXPECT_FALSE(LslNotes::checkName(std::string(101, 'a')));
    EXPECT_TRUE(LslNotes::checkName("Task ä 1"));
}

TEST_F(HostileLsl, WhatIsNotTakenIsCounted) {
    does("loses samples");
    ASSERT_TRUE(openHeard({true, ""}));
    for (int i = 0; i < 10; ++i) lsl_->marker(clock_->now(), "answer");
    const auto lost = end();
    EXPECT_GE(lost.refused, 10U);
    EXPECT_EQ(lost.markers, 0U);

    std::filesystem::remove(path_);
    does("hangs while sending");
    ASSERT_TRUE(openHeard({true, ""}, true));
    for (std::size_t i = 0; i < LslStreams::kMaxWaiting + 500; ++i) lsl_->marker(clock_->now(), "answer");
    const auto hung = end();
    EXPECT_TRUE(hung.hung);
    EXPECT_GE(hung.dropped, 499U) << "one may be with the library";
    EXPECT_LE(hung.dropped, 500U);
    EXPECT_GE(hung.unsent, LslStreams::kMaxWaiting - 1);
    EXPECT_THAT(lslSentence(hung), testing::AllOf(HasSubstr("dropped"), HasSubstr("were not sent"),
                                                  testing::Not(HasSubstr("nothing was lost"))));
    does("nothing");
}

TEST_F(HostileLsl, APilotSessionSendsItsMarkersAlone) {
    RecordProperty("hazard", "H9");
    does("nothing");
    ASSERT_TRUE(LslStreams::prepare({true, ""}, true));
    const int before = created();
    ASSERT_TRUE(openHeard({true, ""}, true));
    EXPECT_EQ(created(), before + 1);
    ASSERT_IN_TIME(armAndDrive(1, 1));
    EXPECT_IN_TIME(comes([&] { return bench_->telemetry().trainsDelivered >= 2; }, 20s));
    lsl_->marker(clock_->now(), "answer");
    const auto tally = end();
    EXPECT_EQ(tally.markers, 1U);
    EXPECT_EQ(tally.frames + tally.trains, 0U);
}

TEST_F(HostileLsl, AFloodOfNotesIsHeldToTwentyASecond) {
    RecordProperty("hazard", "H2");
    does("floods");
    ASSERT_TRUE(openHeard({false, "Task"}));
    ASSERT_IN_TIME(armAndDrive(1, 1));
    std::this_thread::sleep_for(2s);
    EXPECT_NE(bench_->telemetry().state, InterlockState::Faulted);
    const double lasted_s = toSeconds(clock_->now());
    const auto tally = end();
    EXPECT_FALSE(tally.hung);
    EXPECT_GE(tally.notes.taken, 20U);
    EXPECT_LE(double(tally.notes.taken), LslNotes::kPerSecond * (lasted_s + 2));
    EXPECT_GT(tally.notes.left, 1000U);
    EXPECT_EQ(marks().size(), tally.notes.taken);
    EXPECT_THAT(lslSentence(tally), HasSubstr("more than 20 a second"));
}

TEST_F(HostileLsl, AnyTextBecomesAPrintableNoteOrIsCounted) {
    RecordProperty("hazard", "H10");
    const std::pair<const char*, std::string> texts[] = {
        {"sends a mebibyte", "\\xe4\\xe4"},
        {"sends bytes", "a\\x00b\\x1b[2J\\xff\xc3\xb6"},
    };
    for (const auto& [what, says] : texts) {
        SCOPED_TRACE(what);
        std::filesystem::remove(path_);
        does(what);
        ASSERT_TRUE(openHeard({false, "Task"}));
        EXPECT_IN_TIME(comes([] { return given() > 3; }, 20s));
        const auto tally = end();
        const auto all = marks();
        ASSERT_EQ(all.size(), 3U);
        EXPECT_EQ(tally.notes.taken, 3U);
        EXPECT_EQ(tally.notes.shortened, what == std::string("sends a mebibyte") ? 3U : 0U);
        EXPECT_EQ(tally.notes.unstamped, what == std::string("sends bytes") ? 3U : 0U);
        const auto text = all.front()["text"].get<std::string>();
        EXPECT_THAT(text, HasSubstr(says));
        EXPECT_LE(text.size(), LslNotes::kMaxBytes);
        EXPECT_EQ(printable(text), text);
        EXPECT_EQ(all.front()["stream"], "Task");
    }
}

TEST_F(HostileLsl, AStreamThatIsNoTextIsNamed) {
    for (const auto& [what, says] :
         {std::pair{"has numbers", "holds numbers (channels: 1); one channel of text is expected"},
          {"has two channels", "holds texts (channels: 2)"},
          {"finds nothing", "never found"}}) {
        SCOPED_TRACE(what);
        std::filesystem::remove(path_);
        does(what);
        ASSERT_TRUE(openHeard({false, "Task"}));
        EXPECT_IN_TIME(comes([] { return looked() > 1; }, 20s));
        EXPECT_THAT(lslSentence(end()), HasSubstr(says));
    }
}

TEST(LslNotes, StampsThatCannotBeAreSaid) {
    LslLibrary library{};
    library.localClock = [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    };
    const SteadyClock session;
    const auto clock = LslClock::match(library, session).value();
    const auto now = Instant(20s);
    const auto sound = LslNotes::noteOf("x", clock.stampOf(12.5), clock, now);
    EXPECT_TRUE(sound.stamped);
    EXPECT_NEAR(toSeconds(sound.at), 12.5, 1e-6);
    for (const double wrong :
         {0.0, -1.0, 1e300, double(INFINITY), double(NAN), clock.stampOf(-0.001), clock.stampOf(20.1)}) {
        const auto note = LslNotes::noteOf("x", wrong, clock, now);
        EXPECT_FALSE(note.stamped) << wrong;
        EXPECT_EQ(note.at, now) << wrong;
    }
    const auto text = LslNotes::noteOf(std::string(199, 'x') + "ä", 0, clock, now).text;
    EXPECT_EQ(text, std::string(199, 'x')) << "no half of a character";
}

}  // namespace
}  // namespace tacto
