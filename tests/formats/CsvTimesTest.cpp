// The stamps of a long table are not kept, but the result is the same as if they were. Samples that do not fit into
// memory give an error, not an exception.
#include <cmath>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <stdexcept>

#include "core/formats/CaptureFormats.h"
#include "core/formats/csv/CsvFormat.h"
#include "core/formats/csv/CsvTimes.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using ::testing::HasSubstr;

struct JudgedStamps {
    double rate_hz = 0, start_s = 0;
    std::vector<std::string> texts;  // warnings or the error
    bool needsAll = false;
    bool operator==(const JudgedStamps& other) const {
        return rate_hz == other.rate_hz && start_s == other.start_s && texts == other.texts;
    }
};

/// Adds stamps as readCsvTable() does, of which `keptRows` count. With `all`, every stamp is added a second time.
JudgedStamps judgeStamps(const std::vector<double>& stamps, const CsvLayout& layout, std::size_t keptRows, bool all) {
    CsvTimes times(layout);
    std::vector<std::size_t> lines(stamps.size());
    for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = i + 2;
    constexpr std::size_t kBatch = 1000;
    const auto add = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; i += kBatch) {
            const auto count = std::min(kBatch, to - i);
            times.add(std::span(stamps).subspan(i, count), std::span(lines).subspan(i, count));
        }
    };
    add(0, keptRows);
    if (keptRows < stamps.size()) {
        times.keep();
        add(keptRows, stamps.size());
        times.dropBehindKept();
    }
    JudgedStamps judged;
    judged.needsAll = times.needsAll();
    if (all || judged.needsAll) {
        times.startAgain();
        for (std::size_t i = 0; i < stamps.size(); i += kBatch)
            times.addAgain(std::span(stamps).subspan(i, std::min(kBatch, stamps.size() - i)));
        EXPECT_TRUE(times.hasAll());
    }
    CaptureReading reading;
    const auto set = times.into(reading, "t.csv");
    judged.rate_hz = reading.capture.rate_hz;
    judged.start_s = reading.capture.start_s;
    judged.texts = set ? reading.warnings : std::vector{set.error().message};
    return judged;
}

std::vector<double> evenStamps(std::size_t rows, double step, double digit) {
    std::vector<double> stamps(rows);
    for (std::size_t i = 0; i < rows; ++i) {
        const double exact = -0.5 + static_cast<double>(i) * step;
        stamps[i] = digit > 0 ? std::round(exact / digit) * digit : exact;
    }
    return stamps;
}

struct StampCase {
    const char* name;
    std::vector<double> stamps;
    std::optional<double> stated;
    bool needsAll;
};

std::vector<StampCase> stampCases() {
    constexpr std::size_t kRows = 30'000;
    constexpr double kStep = 1.00013e-5;
    auto jump = evenStamps(kRows, kStep, 0);
    for (std::size_t i = 20'000; i < kRows; ++i) jump[i] += 3 * kStep;
    auto missing = evenStamps(kRows, kStep, 0);
    missing[25'000] = NAN;
    auto back = evenStamps(kRows, kStep, 0);
    std::swap(back[29'000], back[29'001]);
    auto drift = evenStamps(kRows, kStep, 0);
    for (std::size_t i = 5000; i < kRows; ++i) drift[i] += 1e-5 * kStep * static_cast<double>(i - 5000);
    auto strays = evenStamps(kRows, kStep, 0);
    strays[17'777] += 0.4 * kStep;
    auto huge = evenStamps(kRows, kStep, 0);
    for (std::size_t i = 0; i < kRows; ++i) huge[i] = i % 2 == 0 ? -1.7e308 : 1.7e308;
    auto behindHead = evenStamps(kRows, kStep, 0);
    for (std::size_t i = CsvTimes::kKept; i < kRows; ++i) behindHead[i] = behindHead[CsvTimes::kKept - 1];
    return {{"even", evenStamps(kRows, kStep, 0), {}, false},
            {"rounded to a tenth of a step", evenStamps(kRows, kStep, 1e-6), {}, false},
            {"rounded to half a step", evenStamps(kRows, kStep, 5.4e-6), {}, true},
            {"coarse", evenStamps(kRows, kStep, 1e-4), {}, true},
            {"as the header states", evenStamps(kRows, kStep, 1e-6), kStep, false},
            {"coarse, and the header states the step", evenStamps(kRows, kStep, 1e-4), kStep, true},
            {"coarse within what the header allows", evenStamps(kRows, kStep, 8e-6), kStep, false},
            {"beside what the header states", evenStamps(kRows, kStep, 1e-6), 2e-5, false},
            {"a jump", jump, {}, true},
            {"one missing", missing, {}, false},
            {"two in the wrong order", back, {}, true},
            {"drifting", drift, {}, false},
            {"one astray", strays, {}, true},
            {"beyond any step", huge, {}, true},
            {"standing still", behindHead, {}, true},
            {"as long as what is kept", evenStamps(CsvTimes::kKept, kStep, 0), {}, false},
            {"one longer", evenStamps(CsvTimes::kKept + 1, kStep, 0), {}, false}};
}

TEST(CsvTimes, LongTablesAreJudgedAsIfAllStampsWereKept) {
    for (const auto& one : stampCases()) {
        SCOPED_TRACE(one.name);
        CsvLayout layout;
        layout.interval_s = one.stated;
        const auto quick = judgeStamps(one.stamps, layout, one.stamps.size(), false);
        const auto whole = judgeStamps(one.stamps, layout, one.stamps.size(), true);
        EXPECT_EQ(quick, whole) << fmt::format("{} {}", quick.rate_hz, fmt::join(quick.texts, "; "));
        EXPECT_EQ(quick.needsAll, one.needsAll);
    }
}

TEST(CsvTimes, RowsThatWereDroppedLeaveNoTrace) {
    for (const std::size_t keptRows : {3000U, 4096U, 9000U}) {
        auto stamps = evenStamps(12'000, 1e-5, 1e-6);
        const std::vector counting(stamps.begin(), stamps.begin() + static_cast<std::ptrdiff_t>(keptRows));
        for (std::size_t i = keptRows; i < stamps.size(); ++i) stamps[i] = i % 3 == 0 ? NAN : 7;
        CsvLayout layout;
        const auto padded = judgeStamps(stamps, layout, keptRows, false);
        EXPECT_EQ(padded, judgeStamps(counting, layout, keptRows, true)) << keptRows;
        EXPECT_FALSE(padded.needsAll);
        EXPECT_TRUE(padded.texts.empty());
    }
}

TEST(CsvTimes, RandomStampsAreJudgedAsIfAllWereKept) {
    std::mt19937 random(20261123);
    std::uniform_real_distribution<double> share(0, 1);
    int again = 0, plain = 0;
    for (int i = 0; i < 300; ++i) {
        const double step = std::pow(10, -9 * share(random));
        auto stamps = evenStamps(4000 + random() % 6000, step, step * 0.6 * share(random));
        const double jitter = 0.3 * share(random) * step;
        for (auto& stamp : stamps) stamp += jitter * (share(random) - 0.5);
        CsvLayout layout;
        if (i % 3 == 0) layout.interval_s = step * (1 + 1e-5 * (share(random) - 0.5));
        const auto quick = judgeStamps(stamps, layout, stamps.size(), false);
        ASSERT_EQ(quick, judgeStamps(stamps, layout, stamps.size(), true)) << i;
        ++(quick.needsAll ? again : plain);
    }
    EXPECT_GT(again, 50);
    EXPECT_GT(plain, 50);
}

TEST(CsvTimes, ALongTableThatIsNotPlainlyEvenIsReadAgain) {
    std::string text = "time_s,a_v\n";
    for (int i = 0; i < 60'000; ++i) text += fmt::format("{:.4f},{}\n", 1.0001e-5 * i, i % 7);
    std::vector<double> told;
    const auto read = accepted(parseCapture(text, "t.csv", {}, {[&](double part) { told.push_back(part); }, {}}));
    EXPECT_EQ(read.capture.samples(), 60'000U);
    EXPECT_NEAR(read.capture.rate_hz, 99'990, 20);
    ASSERT_EQ(read.warnings.size(), 1U);
    EXPECT_THAT(read.warnings.front(), HasSubstr("time stamps move by at least 0.0001 s"));
    EXPECT_TRUE(std::ranges::is_sorted(told)) << "progress goes back";
}

/// A format whose samples do not fit into memory.
class TooLarge final : public CaptureFormat {
public:
    explicit TooLarge(bool beyondAny) : beyondAny_(beyondAny) {}
    std::string_view id() const noexcept override { return "large"; }
    std::string_view name() const noexcept override { return "Large"; }
    std::vector<std::string_view> suffixes() const override { return {".csv"}; }
    bool recognises(const std::filesystem::path&, std::string_view) const override { return true; }
    Result<CaptureReading> read(const std::filesystem::path&, const ReadOptions&, const ReadWatch&) const override {
        if (!beyondAny_) throw std::bad_alloc();
        CaptureReading reading;
        reading.capture.channels.emplace_back().samples.reserve(static_cast<std::size_t>(-1));
        return reading;
    }

private:
    bool beyondAny_;
};

TEST(CaptureFormats, SamplesThatDoNotFitIntoMemoryAreAnErrorThatNamesTheFile) {
    RecordProperty("hazard", "H10");
    const ScratchDir scratch;
    const auto path = scratch.write("huge.csv", "time_s,a\n0,1\n1,2\n");
    const auto expected =
        "huge.csv: its samples do not fit into memory; a shorter record, or fewer of its channels, was expected";
    const ReadWatch outOfMemory{[](double) { throw std::bad_alloc(); }, {}};
    std::vector<Result<CaptureReading>> readings;
    for (const bool beyondAny : {false, true}) {
        CaptureFormats formats;
        formats.add(std::make_unique<TooLarge>(beyondAny));
        readings.push_back(formats.read(path));
    }
    readings.push_back(ownCaptureFormats()->read(path, {}, outOfMemory));
    readings.push_back(readCapture(path, {}, outOfMemory));
    readings.push_back(parseCapture("time_s,a\n0,1\n1,2\n", "huge.csv", {}, outOfMemory));
    for (const auto& reading : readings) {
        ASSERT_FALSE(reading);
        EXPECT_EQ(reading.error().code, ErrorCode::Io);
        EXPECT_THAT(reading.error().message, testing::EndsWith(expected));
    }
}

}  // namespace
}  // namespace tacto::test
