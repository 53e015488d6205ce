// A refusal names options that read the file, and a test applies them. If there are none, the refusal says what was
// expected in the file.
#include <array>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include "core/formats/CaptureFormats.h"
#include "core/formats/csv/CsvFormat.h"
#include "tests/formats/WrittenTables.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"
#include "tests/support/TakenAdvice.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

using ::testing::HasSubstr;

/// Expects a refusal that names options which work, or says what was expected. Returns whether it named options.
bool expectHonest(const std::string& text, const ReadOptions& options = {}) {
    const auto refused = parseCapture(text, "t.csv", options);
    if (refused) return false;
    const auto& sentence = refused.error().message;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    const auto words = advisedWords(sentence);
    if (words.empty()) {
        EXPECT_THAT(sentence, ::testing::AnyOf(HasSubstr("expected"), HasSubstr("there are"))) << text;
        return false;
    }
    const auto read = parseCapture(text, "t.csv", withAdvice(options, words));
    EXPECT_TRUE(read) << sentence << "\n" << (read ? "" : read.error().message) << "\n" << text;
    return true;
}

struct RefusedFile {
    std::string text;
    std::string ends;  ///< end of the sentence
    ReadOptions options{};
};

TEST(CsvAdvice, NamesTheOptionWithItsValueForThisFile) {
    RecordProperty("hazard", "H10");
    const std::string seconds = "; --time-column 1 reads it, its numbers as seconds";
    const std::string rate = "; --sample-rate HZ reads it, where HZ is the instrument's rate";
    const RefusedFile files[] = {
        {"0,1\n0.5,2\n1,3\n", seconds},
        {"a,b\n7,1\n9,2\n11,7\n", seconds},
        {"b,a\n5,0\n5,1\n7,2\n", "; --time-column 2 reads it, its numbers as seconds"},
        {"a,b\n7,1\n9,2\n2,1\n", rate},
        {"3\n1\n2\n", rate},
        {"CH1,CH2\n1,2\n1,3\n2,4\n", rate},
        {"x,y\n0,1\n0.1,3\n0.2,4\n", seconds},
        {"CH1,CH2,Start,Increment,\n1,2,\n3,4,\n2,2,\n", rate},
        {"time_s,force (lbf)\n0,1\n1,2\n", "; --unit 2=V reads it, its numbers as volts"},
        {"time_s,a,a\n0,1,2\n1,2,3\n", "; --columns 2,3 reads it"},
        {"time_s,,b\n0,1,2\n1,2,3\n", "; --columns 2,3 reads it"},
        {"time_s,a,b\n0,1,2\n1,x,3\n2,5,3\n", "; --columns 3 reads it"},
        {"time_s,a,b\n0,--,2\n1,1,3\n2,5,3\n", "; --columns 3 reads it"},
        {"time_s,note,b\n0,1,2\n1,2,2\n2,ERR,2\n", "; --columns 3 reads it"},
        {"Time (s),A (V),Time (s),B (V)\n0,1,5,1\n1,1,6,1\n2,2,7,1\n", "; --columns 2 reads it"},
        {"time_s,a\n0,1\n1,1\n2,1\n9,1\n10,1\n",
         "; where the samples are even all the same, --sample-rate 1 reads them"},
        {"Memory Length,3,\nSource,CH1,\nVertical Scale,none,\nSampling Period,4E-06,\nWaveform Data,\n1,\n2,\n3,\n",
         "; --format csv reads it"},
        {"3,5\ntime_s,a\n0,1\n1,2\n", "; --skip-rows 1 reads it"},
        {"time_s,a\n0,1\n1,2\n", "; --columns 2 reads it", {.columns = {"CH7"}}},
        {"t,a\n0,1\n1,2\n", "; --time-column 1 reads it", {.timeColumn = "when"}},
        {"when,a (V)\n0,1\n1,2\n", "; --time-column 1 reads it, its numbers as seconds", {.timeColumn = "2"}},
        {"time_s,a\n0,1\n1,2\n", "; --format csv reads it", {.format = "csv-rigol"}},
    };
    for (const auto& file : files) {
        EXPECT_THAT(parseCapture(file.text, "t.csv", file.options), test::refusedSaying(testing::EndsWith(file.ends)))
            << file.text;
        EXPECT_TRUE(expectHonest(file.text, file.options));
    }
}

TEST(CsvAdvice, AsksForAnotherFileWhereNoOptionHelps) {
    for (const auto* text : {"", "time_s,a\n", "time_s,a\n0,1\n", "time_s,a\n0,x\n1,y\n", "time_s,a\n0,1\n1\n",
                             "time_s,a\n0,1,5\n0,2,7\n", "time_s,a\n0,5,1,5\n1,5,2,5\n", "\n\n",
                             "LECROYWP715Zi-A,57936,Waveform\nSegments,2,SegmentSize,2\nSegment,TrigTime,T\n"
                             "#1,03-May-2017 11:41:40,0\nTime,Ampl\n0,1\n1,1\n0,1\n1,1\n",
                             "frequency (Hz),magnitude (dB)\n0,x\n1,y\n"}) {
        const auto refused = parseCapture(text, "t.csv");
        ASSERT_FALSE(refused) << text;
        EXPECT_THAT(refused.error().message, HasSubstr("expected")) << text;
        EXPECT_THAT(refused.error().message, ::testing::Not(HasSubstr("--"))) << text;
    }
}

// Options that would misread the table are never suggested: a row as names, times without their unit, an index as
// seconds.
TEST(CsvAdvice, NeverAdvisesWhatWouldBeRead) {
    for (const auto* text :
         {"time_ms,a\n0,1\n1,abc\n2,1\n", "X,CH1,Start,Increment,\nSequence,Volt,0,none,\n0,1,\n1,2,\n2,2,\n",
          "time_ms,a\n0,1,2\n1,2,2\n2,2,3\n", "index,CH1_Voltage(mV)\n0,1\n1,2\n2,2\n"}) {
        const auto refused = parseCapture(text, "t.csv");
        ASSERT_FALSE(refused) << text;
        EXPECT_THAT(refused.error().message, ::testing::Not(HasSubstr("--time-column"))) << text;
        EXPECT_THAT(refused.error().message, ::testing::Not(HasSubstr("--skip-rows"))) << text;
    }
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Damages a file as may happen on its way: a line lost, doubled or foreign, a field emptied, a word instead of a
/// number, a name or unit changed, two lines swapped, bytes lost.
std::string damaged(const std::string& text, Random& random) {
    auto lines = linesOf(text);
    const auto at = [&](std::uint64_t most) {
        return static_cast<std::ptrdiff_t>(random.below(std::max<std::uint64_t>(1, most)));
    };
    const bool atHead = random.below(2) == 0;
    const auto which = at(atHead ? std::min<std::size_t>(lines.size(), 14) : lines.size());
    auto& line = lines[static_cast<std::size_t>(which)];
    const auto separator = line.find(';') != std::string::npos    ? ';'
                           : line.find('\t') != std::string::npos ? '\t'
                                                                  : ',';
    auto fields = split(line, separator);
    std::vector<std::string> changed(fields.begin(), fields.end());
    auto& field = changed[random.below(changed.size())];
    constexpr std::array<std::string_view, 9> kWords{"", "x", "CH1", "none", "time_s", "(bar)", "-", "1.2.3", "12"};
    switch (random.below(8)) {
        case 0:
            lines.erase(lines.begin() + which);
            break;
        case 1:
            lines.insert(lines.begin() + which, std::string(line));
            break;
        case 2:
            std::swap(line, lines[random.below(lines.size())]);
            break;
        case 3:
            lines.insert(lines.begin() + which, "a line of something else");
            break;
        case 4:
            line = line.substr(0, random.below(line.size() + 1));
            break;
        case 5:
            changed.erase(changed.begin() + (&field - changed.data()));
            [[fallthrough]];
        case 6:
            line = fmt::format("{}", fmt::join(changed, std::string(1, separator)));
            break;
        default:
            field = kWords[random.below(kWords.size())];
            line = fmt::format("{}", fmt::join(changed, std::string(1, separator)));
    }
    return fmt::format("{}\n", fmt::join(lines, "\n"));
}

TEST(CsvAdvice, OfDamagedTablesIsHonest) {
    RecordProperty("hazard", "H10");
    Random random(20261129, "damage");
    int refused = 0;
    int withAdvice = 0;
    const int tables = trials<int>({.local = 400, .ci = 1000, .campaign = 20'000});
    for (int i = 0; i < tables; ++i) {
        auto text = anyWrittenTable(random).text;
        for (auto mishaps = 1 + random.below(3); mishaps > 0; --mishaps) text = damaged(text, random);
        refused += parseCapture(text, "t.csv") ? 0 : 1;
        withAdvice += expectHonest(text) ? 1 : 0;
        if (HasFailure()) return;
    }
    EXPECT_GT(refused, tables / 10);
    EXPECT_GT(withAdvice, refused / 10) << refused;
}

// Names of a file and a channel do not hide the advice, and the formats give the same advice for a file.
TEST(CsvAdvice, IsTheSameForFiles) {
    const ScratchDir scratch;
    const auto path = scratch.write("a.csv", "a,b\n7,1\n9,2\n11,7\n");
    const auto refused = ownCaptureFormats()->read(path);
    ASSERT_FALSE(refused);
    const auto read = accepted(ownCaptureFormats()->read(path, withAdvice({}, advisedWords(refused.error().message))));
    EXPECT_NEAR(read.capture.rate_hz, 0.5, 1e-12);
}

}  // namespace
}  // namespace tacto::test
