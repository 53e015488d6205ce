// XDF, EDF and BDF exports hold for pyxdf, pyEDFlib and edfio what the session holds, and open here as recordings.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <span>

#include "core/dsp/RoughnessAnalysis.h"
#include "core/exchange/Export.h"
#include "core/exchange/SlotFinder.h"
#include "core/exchange/edf/EdfGrid.h"
#include "core/exchange/recordings/OpenRecording.h"
#include "core/session/SessionWriter.h"
#include "tests/exchange/recordings/Readers.h"
#include "tests/session/SessionSupport.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct SignalStreamDrawn {
    SessionStream about;
    std::string name;
    std::vector<std::string> columns, units;
};

/// A session at rates without a common grid, with gaps, jitter, a clock that slips, absent values, one sample and none.
class DrawnSignals {
public:
    DrawnSignals(const fs::path& folder, std::uint64_t seed)
        : random_(seed), folder_(folder), path_(folder / "s.tacto") {
        VirtualClock clock;
        auto writer = SessionWriter::create(path_, test::someAbout(), clock);
        EXPECT_TRUE(writer);
        if (!writer) return;
        auto& session = **writer;
        const std::vector<SignalStreamDrawn> streams{
            {{"accelerometer", "acceleration", "m/s2", {"x", "y", "absent"}, 2200},
             "acceleration",
             {"acceleration_x", "acceleration_y", "acceleration_absent"},
             {"m/s2", "m/s2", "m/s2"}},
            {{"taxels", "taxels", "count", {"c1", "c2"}, 148.31},
             "taxels",
             {"taxels_c1", "taxels_c2"},
             {"count", "count"}},
            {{"force", "force", "N", {"force"}, 99.99}, "force", {"force"}, {"N"}},
            {{"other finger", "acceleration", "m/s2", {"x"}, 62.86}, "acceleration-2", {"acceleration"}, {"m/s2"}},
            {{"one", "lonely", "N", {"lonely"}, 50}, "lonely", {"lonely"}, {"N"}},
            {{"none", "empty", "N", {"empty"}, 50}, "empty", {"empty"}, {"N"}}};
        auto& listed = expected_["streams"] = Json::array();
        for (const auto& stream : streams) listed.push_back(add(session, stream));
        EXPECT_TRUE(session.event(clock.now(), "interlock", {{"text", "armed"}}));
        auto& trains = expected_["trains"] = Json::array();
        auto& trials = expected_["trials"] = Json::array();
        for (int i = 1; i <= 7; ++i) {
            clock.advanceTo(clock.now() + std::chrono::milliseconds(300 + random_() % 500));
            EXPECT_TRUE(session.command(clock.now(), "delivered", {{"amplitude_v", 10.25 + i}, {"interval_s", 0.5}}));
            trains.push_back({toSeconds(clock.now()), 10.25 + i});
            const auto* condition = i % 2 == 0 ? "rough-low" : "smooth";
            EXPECT_TRUE(session.trial(clock.now(), condition, {{"pulses", i}}));
            trials.push_back({toSeconds(clock.now()), i, condition});
        }
        EXPECT_TRUE(
            session.event(clock.now(), kMarksEvent, {{"flags", {"uncalibrated R"}}, {"stimulator_calibrated", false}}));
        EXPECT_TRUE(session.close());
        writer->reset();
        std::ofstream(folder / "expected.json") << expected_.dump();
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    Json add(SessionWriter& session, const SignalStreamDrawn& stream) {
        const auto id = session.addStream(stream.about);
        EXPECT_TRUE(id);
        std::uniform_real_distribution<double> unit(0, 1);
        const auto flaw = random_() % 4;
        const double rate = stream.about.rate_hz * (flaw == 3 ? 1.0007 : 1);
        const std::size_t samples = stream.name == "empty" ? 0
                                    : stream.name == "lonely"
                                        ? 1
                                        : static_cast<std::size_t>(rate * (3 + unit(random_) * 4));
        const bool whole = random_() % 2 == 0;
        const double size = std::pow(10, -3 + static_cast<double>(random_() % 7));
        std::ofstream raw(folder_ / (stream.name + ".f64"), std::ios::binary);
        SampleBlock block;
        double t = unit(random_) * (random_() % 2 == 0 ? 0.01 : 2.5);
        double shortest = INFINITY, longest = 0, last = NAN;
        for (std::size_t i = 0; i < samples; ++i) {
            const double stamp = t + (flaw == 2 ? 0.2 * (unit(random_) - 0.5) / rate : 0);
            if (!std::isnan(last)) {
                shortest = std::min(shortest, stamp - last);
                longest = std::max(longest, stamp - last);
            }
            last = stamp;
            block.t_s.push_back(stamp);
            raw.write(reinterpret_cast<const char*>(&stamp), sizeof stamp);
            for (const auto& column : stream.about.columns) {
                double value = size * (2 * unit(random_) - 1);
                if (whole) value = std::round(1000 * value / size);
                if (column == "absent" || (stream.name == "taxels" && random_() % 20 == 0)) value = NAN;
                block.values.push_back(value);
                raw.write(reinterpret_cast<const char*>(&value), sizeof value);
            }
            t += 1 / rate;
            if (flaw == 1 && random_() % 400 == 0) t += 2 * unit(random_);
        }
        EXPECT_TRUE(session.append(*id, block));
        const bool regular = samples < 2 || (shortest > 0.5 / rate && longest < 1.5 / rate);
        return {{"name", stream.name},   {"kind", stream.about.kind}, {"columns", stream.columns},
                {"units", stream.units}, {"samples", samples},        {"rate", stream.about.rate_hz},
                {"regular", regular}};
    }

    std::mt19937_64 random_;
    fs::path folder_, path_;
    Json expected_;
};

class ExportedSignals : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, ExportedSignals, testing::Values("xdf", "edf", "bdf"),
                         [](const auto& format) { return std::string(format.param); });

TEST_P(ExportedSignals, HoldForOthersReadersWhatTheSessionHolds) {
    RecordProperty("hazard", "H9");
    const auto python = test::pythonWithReaders();
    if (!python) GTEST_SKIP() << test::kNoPackages;
    const auto script = test::sourceDir() / "tests/exchange/recordings/read_signals.py";
    for (std::uint64_t seed = 1; seed <= test::trials<std::uint64_t>({.local = 4, .ci = 12, .campaign = 300}); ++seed) {
        const test::ScratchDir folder;
        const DrawnSignals drawn(folder.path(), seed);
        const auto out = folder.path() / fmt::format("out.{}", GetParam());
        const auto done = exportSession(drawn.path(), *exportFormat(GetParam()), out, "0.0.0-test");
        ASSERT_TRUE(done) << done.error().message;
        std::ofstream(folder.path() / "report.json") << toJson(*done).dump();
        const auto [code, said] =
            test::outputOfShell(fmt::format("'{}' '{}' '{}' '{}' '{}'", *python, script.string(), out.string(),
                                            folder.path().string(), (folder.path() / "report.json").string()));
        ASSERT_EQ(code, 0) << "seed " << seed << '\n' << said;
    }
}

/// A session with the streams of an example, as a fingertip gave them.
fs::path sessionOfTheExample(const fs::path& folder, const Recording& example) {
    auto path = folder / "slide.tacto";
    VirtualClock clock;
    auto writer = SessionWriter::create(path, test::someAbout(), clock);
    EXPECT_TRUE(writer);
    for (const auto& stream : example.streams) {
        std::vector<std::string> columns;
        for (std::size_t c = 0; c < stream.info.channels; ++c)
            columns.push_back(stream.info.channels == 1 ? "force" : fmt::format("c{}", c + 1));
        const auto id = (*writer)->addStream(SessionStream{stream.info.name, std::string(nameOf(stream.info.kind)),
                                                           std::string(symbolOf(stream.info.unit)), columns,
                                                           std::round(stream.info.rate_hz)});
        EXPECT_TRUE(id);
        EXPECT_TRUE((*writer)->append(*id, stream.samples));
    }
    EXPECT_TRUE((*writer)->close());
    return path;
}

TEST_P(ExportedSignals, GiveTheRoughnessOfTheSession) {
    const auto example = Recording::open(test::sourceDir() / "resources/examples/four-touches");
    ASSERT_TRUE(example);
    const test::ScratchDir folder;
    const auto session = sessionOfTheExample(folder.path(), *example);
    const auto out = folder.path() / fmt::format("out.{}", GetParam());
    const auto done = exportSession(session, *exportFormat(GetParam()), out, "0.0.0-test");
    ASSERT_TRUE(done) << done.error().message;
    const auto opened = openRecording(out);
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(opened->simulated, true);
    EXPECT_EQ(opened->streams.size(), example->streams.size());
    const auto whole = analyseRoughness(example->infos(), example->blocks(), {});
    const auto found = analyseRoughness(opened->infos(), opened->blocks(), {});
    ASSERT_TRUE(whole && found);
    EXPECT_EQ(found->summary.frames, whole->summary.frames);
    const bool exact = std::string_view(GetParam()) == "xdf";  // but for stamps, kept within 1 ns
    const double tolerance = exact ? 1e-9 : std::string_view(GetParam()) == "bdf" ? 1e-3 : 2e-2;
    const auto near = [&](double value, double as) { EXPECT_NEAR(value, as, tolerance * std::abs(as)); };
    near(found->summary.h.mean, whole->summary.h.mean);
    near(found->summary.v.mean, whole->summary.v.mean);
    near(found->summary.R.mean, whole->summary.R.mean);
    near(found->summary.pressure_pa.mean, whole->summary.pressure_pa.mean);
}

/// Streams by their kind: rate and samples. Each channel has the values that are given, again and again.
fs::path sessionOf(const fs::path& folder, const std::vector<std::tuple<const char*, double, SampleBlock>>& streams) {
    auto path = folder / "s.tacto";
    VirtualClock clock;
    auto writer = SessionWriter::create(path, test::someAbout(), clock);
    EXPECT_TRUE(writer);
    for (const auto& [kind, rate_hz, samples] : streams) {
        const auto id = (*writer)->addStream(SessionStream{kind, kind, "N", {kind}, rate_hz});
        EXPECT_TRUE(id);
        EXPECT_TRUE((*writer)->append(*id, samples));
    }
    EXPECT_TRUE((*writer)->close());
    return path;
}

class EdfExports : public testing::TestWithParam<const char*> {
protected:
    [[nodiscard]] Result<ExportReport> exported(
        const std::vector<std::tuple<const char*, double, SampleBlock>>& streams) const {
        return exportSession(sessionOf(folder_.path(), streams), *exportFormat(GetParam()), out_, "0.0.0-test");
    }
    const test::ScratchDir folder_;
    const fs::path out_ = folder_.path() / fmt::format("out.{}", GetParam());
};
INSTANTIATE_TEST_SUITE_P(All, EdfExports, testing::Values("edf", "bdf"),
                         [](const auto& format) { return std::string(format.param); });

TEST_P(EdfExports, LeaveOutStreamsThatWouldBeAlmostNothingButAbsent) {
    RecordProperty("hazard", "H9");
    const auto force = test::ramp(0, 100, 500, 1);
    auto glitch = test::ramp(0, 100, 500, 1);
    glitch.t_s.back() = 1e6;
    SampleBlock one;
    one.t_s = {4.5};
    one.values = {1};
    const auto done = exported({{"fast", 1e9, one},
                                {"endless", 1e300, one},
                                {"force", 100, force},
                                {"sparse", 1e8, one},
                                {"lonely", 50, one},
                                {"glitch", 100, glitch}});
    ASSERT_TRUE(done) << done.error().message;
    std::vector<std::string> written, leftOut;
    for (const auto& stream : done->streams) written.push_back(stream.name);
    for (const auto& [what, why] : done->leftOut) leftOut.push_back(what);
    EXPECT_THAT(written, testing::ElementsAre("force", "lonely"));
    EXPECT_THAT(leftOut, testing::UnorderedElementsAre("records", "fast", "endless", "sparse", "glitch"));
    EXPECT_LT(fs::file_size(out_), 100'000U);
    const auto opened = openRecording(out_);
    EXPECT_TRUE(opened) << opened.error().message;
}

TEST_P(EdfExports, CountInfiniteValuesAsAbsent) {
    RecordProperty("hazard", "H9");
    auto force = test::ramp(0, 100, 500, 1);
    force.values[7] = INFINITY;
    force.values[9] = force.values[10] = -INFINITY;
    force.values[11] = NAN;
    const auto done = exported({{"force", 100, force}});
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(done->streams.at(0).channels.at(0).absent, 4U);
    const auto named = std::ranges::find(done->leftOut, "3 infinite values of force", &LeftOut::what);
    EXPECT_NE(named, done->leftOut.end());
}

TEST(EdfGrid, ARecordHasWholeSamplesOfEveryRate) {
    EXPECT_EQ(edf::recordDuration_s(std::vector<double>{2200, 200, 100}, 1e6), 1);
    EXPECT_EQ(edf::recordDuration_s(std::vector<double>{62.5, 4000}, 1e6), 2);
    EXPECT_EQ(edf::recordDuration_s(std::vector<double>{0.1, 4000}, 1e6), 10);
    const std::vector<double> odd{2200, 148.31, 99.99, 62.86};
    const double record_s = edf::recordDuration_s(odd, 1e6);
    double worst = 0;
    for (const double rate : odd)
        worst = std::max(worst, std::abs(std::round(rate * record_s) / (rate * record_s) - 1));
    EXPECT_LT(worst, 1e-4);
    EXPECT_LE(record_s, 60);
}

TEST(SlotFinder, FollowsStampsAsItFindsTheSlotOfEach) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    std::uint64_t followed = 0, dropped = 0, repeated = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const double rate_hz = 50 + 4000 * unit(random), wrong = trial % 3 == 0 ? 1 : 1 + 0.004 * (unit(random) - 0.5);
        const double jitter = trial % 2 == 0 ? 0 : 0.6 * unit(random);
        std::vector<double> t_s;
        double base_s = trial % 5 == 0 ? -0.01 : 0;
        for (int i = 0; i < 1000; ++i) {
            if (random() % 200 == 0) base_s += unit(random);
            if (random() % 300 == 0) base_s -= 2 / rate_hz;
            t_s.push_back(random() % 500 == 0 ? kNaN
                                              : base_s + (i + jitter * (unit(random) - 0.5)) / (rate_hz * wrong));
        }
        SlotFinder each(rate_hz, rate_hz * wrong), fast(rate_hz, rate_hz * wrong);
        for (std::size_t i = 0; i < t_s.size();) {
            const auto more = fast.follow(std::span(t_s).subspan(i, std::min<std::size_t>(t_s.size() - i, 70)));
            for (std::size_t k = 0; k < more; ++k) {
                const auto before = each.lastSlot();
                const auto place = each.next(t_s[i + k]);
                ASSERT_TRUE(place && !place->slipped && place->slot == before + 1);
            }
            followed += more;
            i += more;
            if (i == t_s.size()) break;
            const auto wanted = each.next(t_s[i]), got = fast.next(t_s[i]);
            ++i;
            ASSERT_EQ(wanted.has_value(), got.has_value());
            if (wanted) ASSERT_TRUE(wanted->slot == got->slot && wanted->slipped == got->slipped);
            ASSERT_EQ(each.lastSlot(), fast.lastSlot());
        }
        const auto wanted = each.counts(), got = fast.counts();
        EXPECT_EQ(wanted.dropped, got.dropped);
        EXPECT_EQ(wanted.repeated, got.repeated);
        EXPECT_EQ(wanted.maxTimeError_s, got.maxTimeError_s);
        dropped += got.dropped;
        repeated += got.repeated;
    }
    EXPECT_GT(followed, 100'000U);
    EXPECT_GT(dropped, 1000U);
    EXPECT_GT(repeated, 1000U);
}

int digitalOf(const edf::Scale& scale, double value) {
    int digital = 0;
    scale.digital(&value, 1, std::span(&digital, 1));
    return digital;
}

TEST(EdfGrid, AScaleKeepsWhatItIsGivenToHalfAStep) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 20'000; ++i) {
        const double size = std::pow(10, 6 * unit(random));
        double least = size * unit(random), most = size * unit(random);
        if (least > most) std::swap(least, most);
        const int bits = i % 2 == 0 ? 16 : 24;
        const auto scale = edf::scaleFor(least, most, false, bits);
        ASSERT_TRUE(scale) << least << ' ' << most;
        EXPECT_LE(scale->physicalMin.size(), 7U);
        EXPECT_LE(scale->physicalMax.size(), 7U);
        const double low = std::stod(scale->physicalMin), high = std::stod(scale->physicalMax);
        const double step = (high - low) / (std::pow(2, bits) - 1);
        for (const double value : {least, most, 0.5 * (least + most)}) {
            const int digital = digitalOf(*scale, value);
            EXPECT_GT(digital, -(1 << (bits - 1))) << "the lowest means absent";
            EXPECT_NEAR(low + step * (digital + (1 << (bits - 1))), value, 0.5000001 * step);
        }
    }
    EXPECT_FALSE(edf::scaleFor(0.5, 1e9, false, 16)) << "no decimal of 7 characters";
    const auto counts = edf::scaleFor(-32767, 32767, true, 16);
    ASSERT_TRUE(counts && counts->exact);
    for (const double value : {-32767.0, 0.0, 32767.0}) EXPECT_EQ(digitalOf(*counts, value), value);
    EXPECT_EQ(digitalOf(*counts, NAN), -32768);
    const std::array<double, 7> mixed{1.4, NAN, -1.6, INFINITY, 9e9, 0.0, -9e9};
    std::array<int, 4> every{};
    counts->digital(mixed.data(), 2, every);
    EXPECT_EQ(every, (std::array{1, -2, 32767, -32767})) << "every second; what is outside becomes a limit";
    counts->digital(mixed.data() + 1, 2, std::span(every).first(3));
    EXPECT_EQ(every, (std::array{-32768, -32768, 0, -32767}));
    EXPECT_FALSE(edf::scaleFor(-32768, 5, true, 16)->exact) << "the lowest means absent";
}

}  // namespace
}  // namespace tacto
