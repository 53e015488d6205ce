// What pylsl records of a run is what the session's export holds, and what pylsl sends becomes notes of the session.
// The library is the one that pylsl carries; its settings keep everything on this computer.
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/exchange/lsl/LslClock.h"
#include "core/pilot/PilotRecord.h"
#include "core/session/SessionReader.h"
#include "tests/cli/RunCli.h"
#include "tests/support/InTime.h"
#include "tests/support/PythonEnvironment.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using Json = nlohmann::json;
using testing::ElementsAreArray;
using testing::HasSubstr;

std::optional<std::string> pythonWithLsl() {
    return test::pythonWith("lsl", "pylsl, pyxdf", "pylsl==1.18.6 pyxdf==1.17.5");
}

/// Points this process, and those that it starts, to the library of that Python, which says where it is.
[[nodiscard]] bool useLibraryOf(const std::string& python, const test::ScratchDir& folder) {
    const auto place = test::outputOfShell(
        "'" + python +
        "' -c 'import pylsl, os; print(os.path.join(os.path.dirname(pylsl.__file__), \"lib/liblsl.so.2\"))'");
    if (place.code != 0) return false;
    ::setenv("TACTOSCOPE_LSL",
             place.text.substr(place.text.find('/'), place.text.find('\n', place.text.find('/')) - place.text.find('/'))
                 .c_str(),
             1);
    const auto settings = folder.write(
        "lsl_api.cfg",
        "[multicast]\nResolveScope = machine\n[lab]\nKnownPeers = {127.0.0.1}\n"
        "[ports]\nIPv6 = disable\n[log]\nlevel = -2\n[tuning]\nMulticastMinRTT = 0.1\nUnicastMinRTT = 0.1\n");
    ::setenv("LSLAPICFG", settings.c_str(), 1);
    return true;
}

TEST(LslRun, TheClockOfLslIsTheSteadyClockOfTheComputer) {
    const auto python = pythonWithLsl();
    if (!python) GTEST_SKIP() << test::kNoPackages;
    const test::ScratchDir folder;
    ASSERT_TRUE(useLibraryOf(*python, folder));
    const auto library = LslLibrary::load();
    ASSERT_TRUE(library) << library.error().message;
    EXPECT_GE((*library)->version(), 113);
    const SteadyClock session;
    const auto clock = LslClock::match(**library, session);
    ASSERT_TRUE(clock) << clock.error().message;
    const double before_s = toSeconds(session.now());
    const double stamp_s = (*library)->localClock();
    const double after_s = toSeconds(session.now());
    EXPECT_GE(clock->sessionTime_s(stamp_s), before_s - 1e-3);
    EXPECT_LE(clock->sessionTime_s(stamp_s), after_s + 1e-3);
}

TEST(LslRun, PylslRecordsWhatTheSessionHolds) {
    const auto python = pythonWithLsl();
    if (!python) GTEST_SKIP() << test::kNoPackages;
    const test::ScratchDir folder;
    ASSERT_TRUE(useLibraryOf(*python, folder));
    ::setenv("XDG_DATA_HOME", folder.path().c_str(), 1);
    const auto source = test::sourceDir();
    const auto [code, said] = test::outputOfShell(
        fmt::format("'{}' '{}' '{}' '{}' 1 '{}'", *python, (source / "tests/cli/record_lsl.py").string(), TACTO_CLI,
                    folder.path().string(), (source / "resources/examples/four-touches").string()));
    ASSERT_EQ(code, 0) << said;
    const auto value =
        Json::parse(said.substr(said.rfind("\n{") == std::string::npos ? said.find('{') : said.rfind("\n{") + 1));
    SCOPED_TRACE(value.dump(1));
    for (const auto& [name, stream] : value["streams"].items()) {
        SCOPED_TRACE(name);
        EXPECT_GT(stream["came"].get<int>(), name == "frames" ? 100 : 3);
        EXPECT_LE(stream["came"].get<int>(), stream["exported"].get<int>());
        EXPECT_EQ(stream["unequal"], 0);
        EXPECT_EQ(stream["channels_equal"], true);
    }
    EXPECT_LT(value["spread_s"].get<double>(), 1e-3) << "of the stamps of all streams from the session's times";
    std::set<std::string> ids;
    for (const auto& [name, about] : value["about"].items()) {
        EXPECT_EQ(about["rate"], 0) << name;
        EXPECT_EQ(about["simulated"], "1") << name;
        EXPECT_THAT(about["session"].get<std::string>(), HasSubstr("live")) << name;
        ids.insert(about["source_id"].get<std::string>());
    }
    EXPECT_EQ(ids.size(), 3U);
    // Notes: what was sent, with its own time; a flood only in part.
    const auto sent = value["notes_sent"].get<std::vector<std::string>>();
    ASSERT_EQ(sent.size(), value["notes_came"].size());
    for (std::size_t i = 0; i < sent.size(); ++i) {
        const auto came = value["notes_came"][i].get<std::string>();
        if (sent[i].size() > 200)
            EXPECT_EQ(came, sent[i].substr(0, 200));
        else if (sent[i].starts_with("\u202e"))
            EXPECT_EQ(came, "\\u202eturned");
        else
            EXPECT_EQ(came, sent[i] == "tab\there" ? "tab\\x09here" : sent[i]);
    }
    EXPECT_LT(value["notes_off_s"].get<double>(), 1e-3);
    EXPECT_LT(value["tally"]["notes"]["taken"], 60);
    EXPECT_GE(value["tally"]["notes"]["left"], 150);
    EXPECT_EQ(value["tally"]["dropped"], 0);
    EXPECT_EQ(value["stored"], value["tally"]);
    EXPECT_THAT(value["stderr"].get<std::string>(), HasSubstr("notes came from \"Task"));
}

TEST(LslRun, WhatCannotBeBeginsNothing) {
    const test::Desk desk;
    const test::Words live{"run", "live", "--device", "sim:", "--out", desk.at("out")};
    const auto refusedSaying = [&](const test::Words& more, int code, const char* says) {
        auto words = live;
        words.insert(words.end(), more.begin(), more.end());
        const auto ran = desk.run(words);
        EXPECT_EQ(ran.code, code) << ran.err;
        EXPECT_THAT(ran.err, HasSubstr(says));
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
        EXPECT_FALSE(std::filesystem::exists(desk.at("out")));
    };
    ::setenv("TACTOSCOPE_LSL", "/nowhere/liblsl.so", 1);
    refusedSaying({"--lsl", "--realtime"}, 3, "a file liblsl.so of liblsl 1.13 or newer is expected");
    ::setenv("TACTOSCOPE_LSL", TACTO_HOSTILE_LSL, 1);
    refusedSaying({"--lsl"}, 2, "real time (--realtime, or the session’s own pace) is expected");
    refusedSaying({"--realtime", "--lsl-markers", ""}, 2, "the name of a stream is expected");
    refusedSaying({"--realtime", "--lsl-markers", "Tactoscope-markers"}, 2, "another program's is expected");
    ::unsetenv("TACTOSCOPE_LSL");
}

TEST(LslRun, ARehearsalSendsItsMarkersAlone) {
    RecordProperty("hazard", "H9");
    const test::Desk desk;
    ::setenv("TACTOSCOPE_LSL", TACTO_HOSTILE_LSL, 1);
    auto running = desk.start({"run", "pilot-thresholds", "--device", "sim:", "--out", desk.at("study"), "--set",
                               "participant=virtual:7", "--realtime", "--lsl", "--json"});
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(8);
    EXPECT_IN_TIME(running.waitUntil([&] { return std::chrono::steady_clock::now() > until; }));
    running.signal(SIGINT);
    const auto ran = running.wait();
    ::unsetenv("TACTOSCOPE_LSL");
    const auto value = Json::parse(ran.out);
    const auto& tally = value["lsl"];
    EXPECT_EQ(tally["frames"], 0);
    EXPECT_EQ(tally["trains"], 0);
    const auto reader = SessionReader::open(value["session"].get<std::string>());
    ASSERT_TRUE(reader) << reader.error().message;
    const auto events = reader->events();
    ASSERT_TRUE(events);
    const auto marked = std::ranges::count_if(*events, [](const auto& event) { return hasMarker(event.name); });
    EXPECT_GT(marked, 3);
    // A bench that was too slow writes a fault of its own, which has no marker.
    EXPECT_IN_TIME(tally["markers"] == marked);
}

}  // namespace
}  // namespace tacto
