// ExportSupport.h - sessions drawn at random for the tests of exports, and what was put into them as plain files that
// others' programs read.
//
// Thread-safety: only the test's thread.
#pragma once

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

#include "core/base/JsonText.h"
#include "core/exchange/Export.h"
#include "tests/session/SessionSupport.h"
#include "tests/support/PythonEnvironment.h"

namespace tacto::test {

/// A session with its streams' samples as raw doubles: one file a stream, `NAME.f64`, rows of time and channels.
struct DrawnSession {
    std::filesystem::path path;
    nlohmann::json expected = nlohmann::json::object();  ///< streams: [{name, columns, units, samples}], trials, events
};

/// Draws the next number: plain, tiny, huge, whole, -0 or absent.
inline double drawnValue(std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    switch (random() % 8) {
        case 0:
            return std::floor(1000 * unit(random));
        case 1:
            return unit(random) * 1e-310;
        case 2:
            return unit(random) * 1e300;
        case 3:
            return -0.0;
        case 4:
            return kNaN;
        default:
            return 10 * unit(random);
    }
}

/// Draws stamps: regular, jittering, with gaps, now and then equal to the stamp before, or by a clock that is a little
/// slow or fast.
inline std::vector<double> drawnStamps(std::mt19937_64& random, double rate_hz, std::size_t samples) {
    std::uniform_real_distribution<double> unit(0, 1);
    const auto flaw = random() % 5;  // 0: none
    const double slip = random() % 2 == 0 ? 0.0008 : -0.0008;
    std::vector<double> stamps;
    double t = unit(random);
    for (std::size_t i = 0; i < samples; ++i) {
        stamps.push_back(t);
        t += 1 / rate_hz;
        if (flaw == 1 && random() % 50 == 0) t += unit(random);               // a gap
        if (flaw == 2) t += (unit(random) - 0.5) * 0.9 / rate_hz;             // jitter
        if (flaw == 3 && random() % 200 == 0) t -= (random() % 2) / rate_hz;  // repeated
        if (flaw == 4) t += slip / rate_hz;
    }
    return stamps;
}

struct DrawnStream {
    SessionStream about;
    std::string name;  ///< in exports
    std::vector<std::string> channels, units;
    std::size_t samples;
};

/// Streams at rates that have no common grid, a second one of a kind, one with an absent column, one sample, none.
inline std::vector<DrawnStream> drawnStreams(std::mt19937_64& random) {
    const auto some = [&] { return static_cast<std::size_t>(200 + random() % 3000); };
    return {
        {{"fingertip accelerometer", "acceleration", "m/s2", {"x", "y", "z"}, 2200},
         "acceleration",
         {"acceleration_x", "acceleration_y", "acceleration_z"},
         {"m/s2", "m/s2", "m/s2"},
         some()},
        {{"taxels", "taxels", "count", {"c1", "absent"}, 148.31},
         "taxels",
         {"taxels_c1", "taxels_absent"},
         {"count", "count"},
         some()},
        {{"force", "force", "N", {"force"}, 99.99}, "force", {"force"}, {"N"}, random() % 2 == 0 ? 1 : some()},
        {{"roughness frames", "frames", "", {"contact", "R", "pressure_pa"}, 0},
         "frames",
         {"contact", "R", "pressure_pa"},
         {"1", "1", "Pa"},
         some()},
        {{"other finger", "acceleration", "m/s2", {"x"}, 62.86}, "acceleration-2", {"acceleration"}, {"m/s2"}, some()},
        {{"a, \"quoted\" name", "telemetry", "", {"level_v"}, 0}, "telemetry", {"telemetry"}, {"1"}, 0}};
}

inline DrawnSession drawSession(const std::filesystem::path& folder, std::uint64_t seed, bool closed = true) {
    std::mt19937_64 random(seed);
    DrawnSession drawn{.path = folder / fmt::format("drawn-{}.tacto", seed)};
    VirtualClock clock;
    auto writer = SessionWriter::create(drawn.path, someAbout(), clock);
    EXPECT_TRUE(writer) << (writer ? "" : writer.error().message);
    if (!writer) return drawn;
    auto& session = **writer;
    auto& streams = drawn.expected["streams"] = nlohmann::json::array();
    for (const auto& stream : drawnStreams(random)) {
        const auto id = session.addStream(stream.about);
        EXPECT_TRUE(id);
        const auto columns = stream.channels.size();
        std::ofstream out(folder / (stream.name + ".f64"), std::ios::binary);
        SampleBlock block;
        const auto flush = [&] {
            EXPECT_TRUE(session.append(*id, block));
            block.clear();
        };
        const double rate = stream.about.rate_hz > 0 ? stream.about.rate_hz : 62.5;
        for (const double t : drawnStamps(random, rate, stream.samples)) {
            block.t_s.push_back(t);
            out.write(reinterpret_cast<const char*>(&t), sizeof t);
            for (std::size_t c = 0; c < columns; ++c) {
                const double value = stream.about.columns[c] == "absent" ? kNaN : drawnValue(random);
                block.values.push_back(value);
                out.write(reinterpret_cast<const char*>(&value), sizeof value);
            }
            if (random() % 300 == 0) flush();
        }
        flush();
        streams.push_back({{"name", stream.name},
                           {"columns", stream.channels},
                           {"units", stream.units},
                           {"samples", stream.samples}});
    }
    auto& trials = drawn.expected["trials"] = nlohmann::json::array();
    auto& events = drawn.expected["events"] = nlohmann::json::array();
    const auto event = [&](std::string_view name, const nlohmann::json& details) {
        clock.advanceTo(clock.now() + std::chrono::milliseconds(random() % 1000));
        EXPECT_TRUE(session.event(clock.now(), name, details));
        events.push_back({toSeconds(clock.now()), name, details});
    };
    event("armed, \"so\"", {{"load", "1 kohm\nor so"}, {"text", "µΩ"}});
    for (int i = 1; i <= 5; ++i) {
        clock.advanceTo(clock.now() + std::chrono::milliseconds(500));
        const auto onset = clock.now();
        EXPECT_TRUE(
            session.command(onset, "train", {{"amplitude_v", 10.0 + i}, {"roughness", 0.1 * i}, {"pressure", 0.5}}));
        const char* became = i == 3 ? "voided" : i == 4 ? "failed" : "delivered";
        EXPECT_TRUE(session.command(onset, became,
                                    {{"amplitude_v", 10.25 + i},
                                     {"measured", 10.5 + i},
                                     {"interval_s", 0.5},
                                     {"is_check", 0.0},
                                     {"text", "unplugged"}}));
        if (i == 3) event("estimate", {{"name", "detection"}, {"estimate", {{"value", 2.5}, {"low", 2}, {"high", 3}}}});
        if (i == 5) event("refused", {{"text", "38 V; at most 30 V are allowed"}});
        const nlohmann::json measured = {{"amplitude_v", drawnValue(random)},
                                         {"pulses", i},
                                         {"captures", {i}},
                                         {"warnings", nlohmann::json::array({"one, two", "three"})}};
        EXPECT_TRUE(session.trial(clock.now(), i % 2 == 0 ? "rough-high" : "smooth, low", measured));
        trials.push_back({toSeconds(clock.now()), i, i % 2 == 0 ? "rough-high" : "smooth, low",
                          numberOrNull(numberOr(measured, "amplitude_v")), i});
        Capture capture;
        capture.rate_hz = 1e6;
        capture.start_s = toSeconds(onset);
        capture.trigger_s = capture.start_s + 0.001;
        capture.simulated = true;
        capture.channels = {{"voltage", "V", {}, -50, 50, 0.4, 0.01, 0.2},
                            {"current", "A", {}, -0.2, 0.2, 0.001, 0, 0}};
        for (int k = 0; k < 500; ++k) {
            for (auto& channel : capture.channels) channel.samples.push_back(static_cast<float>(random() % 1000) / 7);
        }
        EXPECT_TRUE(session.capture(clock.now(), capture, i));
    }
    event(kMarksEvent, {{"flags", {"uncalibrated R"}}, {"stimulator_calibrated", false}});
    EXPECT_TRUE(session.verdict(clock.now(), "separability", "pass", {"apart"}, {{"accuracy", 1.0}}));
    if (closed) EXPECT_TRUE(session.close());
    writer->reset();
    std::ofstream(folder / "expected.json") << drawn.expected.dump();
    return drawn;
}

/// Names in a folder that an export may have left.
inline std::vector<std::string> namesIn(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& each : std::filesystem::directory_iterator(folder)) names.push_back(each.path().filename());
    std::ranges::sort(names);
    return names;
}

/// All bytes below a path, by the names of its files.
inline std::string bytesBelow(const std::filesystem::path& path) {
    if (!std::filesystem::is_directory(path)) {
        const auto bytes = bytesOf(path);
        return {bytes.begin(), bytes.end()};
    }
    std::vector<std::filesystem::path> files;
    for (const auto& each : std::filesystem::recursive_directory_iterator(path))
        if (each.is_regular_file()) files.push_back(each.path());
    std::ranges::sort(files);
    std::string all;
    for (const auto& file : files) {
        const auto bytes = bytesOf(file);
        all += file.lexically_relative(path).string() + "\n" + std::string(bytes.begin(), bytes.end());
    }
    return all;
}

}  // namespace tacto::test
