// The same samples in every form in which laboratories save them: encodings, decimal signs, separators, headers, times
// or a rate, units, missing cells. The results are compared with the numbers that were written.
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "core/acquisition/Recording.h"
#include "core/acquisition/RecordingTable.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

using namespace tacto;
using tacto::test::ScratchDir;
using testing::HasSubstr;
using Json = nlohmann::json;

namespace {

struct Spelling {
    const char* text;
    double factor;  // factor to seconds, or to m/s2, N or Pa, from the definition of the unit
};
const std::vector<Spelling> kTimes{{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"µs", 1e-6}, {"μs", 1e-6}, {"ns", 1e-9}};
const std::vector<Spelling> kAccelerations{{"m/s2", 1},        {"m/s²", 1},  {"m/s^2", 1},     {"m·s⁻²", 1},
                                           {"m s^-2", 1},      {"m/s/s", 1}, {"mm/s²", 0.001}, {"g", 9.80665},
                                           {"mg", 0.00980665}, {"count", 1}};
const std::vector<Spelling> kForces{{"N", 1}, {"mN", 1e-3}, {"kN", 1e3}, {"count", 1}};
const std::vector<Spelling> kPressures{{"Pa", 1}, {"hPa", 100}, {"kPa", 1e3}, {"MPa", 1e6}, {"count", 1}};

/// Returns `text` in UTF-16. It must not contain characters above U+FFFF.
std::string utf16(const std::string& text, bool big) {
    std::string out;
    const auto put = [&](unsigned unit) {
        const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 0xFF);
        out += big ? high : low;
        out += big ? low : high;
    };
    put(0xFEFF);
    for (std::size_t i = 0; i < text.size();) {
        const auto c = static_cast<unsigned char>(text[i]);
        const auto next = [&](std::size_t k) { return static_cast<unsigned char>(text[i + k]) & 0x3FU; };
        if (c < 0x80) {
            put(c);
            i += 1;
        } else if (c < 0xE0) {
            put((c & 0x1FU) << 6U | next(1));
            i += 2;
        } else {
            put((c & 0x0FU) << 12U | next(1) << 6U | next(2));
            i += 3;
        }
    }
    return out;
}

/// Returns `text` in Latin-1, as old programs write it; unchanged if it has other characters.
std::string latin1(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (c >= 0xC4) return text;
        out += c < 0x80 ? text[i] : static_cast<char>((c & 3U) << 6U | (static_cast<unsigned char>(text[++i]) & 0x3FU));
    }
    return out;
}

class Draw {
public:
    explicit Draw(unsigned seed) : random_(seed) {}
    int from(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
    bool chance(int percent) { return from(1, 100) <= percent; }
    template <class T>
    const T& of(const std::vector<T>& all) {
        return all[static_cast<std::size_t>(from(0, static_cast<int>(all.size()) - 1))];
    }

private:
    std::mt19937 random_;
};

/// A random table, its description and its contents.
struct Drawn {
    std::string bytes;
    Json stream;
    std::vector<double> t_s, values;  // NaN: missing
    std::string form;
};

Drawn drawTable(unsigned seed) {
    Draw draw(seed);
    Drawn out;
    const auto kind = draw.of<std::string>({"acceleration", "force", "taxels"});
    const auto& units = kind == "acceleration" ? kAccelerations : kind == "force" ? kForces : kPressures;
    const auto unit = draw.of(units);
    const int channels = kind == "acceleration" ? draw.from(1, 3) : kind == "force" ? 1 : draw.from(2, 8);
    const bool byRate = draw.chance(40), headed = draw.chance(60);
    const bool byName = headed && draw.chance(80);
    const auto timeUnit = draw.of(kTimes);
    const bool comma = draw.chance(50);
    const std::string separator = comma ? draw.of<std::string>({";", "\t"}) : draw.of<std::string>({",", ";", "\t"});
    const std::string newline = draw.chance(50) ? "\r\n" : "\n";
    const double rate_hz = draw.of<double>({100, 200, 1000, 2500, 4000});

    // The columns of the stream are in any order, with others between them.
    struct Column {
        std::string name;
        int channel;  // -1: the time; -2: another column
    };
    std::vector<Column> columns;
    for (int c = 0; c < channels; ++c) columns.push_back({fmt::format("{}{}", kind.substr(0, 2), c + 1), c});
    if (!byRate) columns.push_back({draw.of<std::string>({"time", "t", "Zeit / s", "µs"}), -1});
    for (int i = draw.from(0, 2); i > 0; --i) columns.push_back({fmt::format("other{}", i), -2});
    for (std::size_t i = columns.size() - 1; i > 0; --i)
        std::swap(columns[i], columns[static_cast<std::size_t>(draw.from(0, static_cast<int>(i)))]);

    const auto number = [&](long long mantissa, int decimals) {
        auto text = fmt::format("{}", std::abs(mantissa));
        if (decimals > 0) {
            while (text.size() <= static_cast<std::size_t>(decimals)) text.insert(0, "0");
            text.insert(text.size() - static_cast<std::size_t>(decimals), 1, comma ? ',' : '.');
        }
        return (mantissa < 0 ? "-" : "") + text;
    };
    const auto valueOf = [](long long mantissa, int decimals) {
        return static_cast<double>(mantissa) / std::pow(10.0, decimals);
    };

    std::string text;
    const auto line = [&](const std::string& content) { text += content + newline; };
    int lines = 0;
    if (headed) {
        for (int i = draw.chance(50) ? draw.from(1, 30) : 0; i > 0; --i, ++lines)
            line(draw.of<std::string>({"# a remark", "Session" + separator + "seven",
                                       "record_frequency" + separator + "12", "made by hand", ""}));
        std::string names, unitsBelow;
        for (const auto& column : columns) {
            names += (names.empty() ? "" : separator) + column.name;
            unitsBelow += unitsBelow.empty() && &column == &columns.front() ? "" : separator;
            unitsBelow += column.channel == -1   ? std::string("[") + timeUnit.text + "]"
                          : column.channel == -2 ? std::string()
                                                 : std::string("[") + unit.text + "]";
        }
        line(names);
        ++lines;
        if (draw.chance(20)) {
            line(unitsBelow);
            ++lines;
        }
    }
    const int rows = draw.from(30, 200);
    const int decimals = draw.from(comma ? 1 : 0, 6);
    const bool gaps = draw.chance(50), wholeRows = draw.chance(50);
    const long long start = draw.from(0, 1000);
    for (int r = 0; r < rows; ++r) {
        // The last row always has values, because an empty row at the end is skipped.
        const bool missingRow = gaps && wholeRows && r > 0 && r + 1 < rows && draw.chance(3);
        std::vector<double> sample(static_cast<std::size_t>(channels));
        std::string row;
        for (const auto& column : columns) {
            if (&column != &columns.front()) row += separator;
            if (column.channel == -1) {
                // Rounded to the nanosecond, in the unit of the file.
                const auto ns = static_cast<long long>((static_cast<double>(start + r)) * 1e9 / rate_hz);
                const int digits = static_cast<int>(std::lround(9 + std::log10(timeUnit.factor)));
                row += number(ns, digits);
            } else if (column.channel == -2) {
                row += draw.chance(80) ? number(draw.from(0, 99), 1) : std::string();
            } else {
                const long long mantissa = draw.from(-9'999'999, 9'999'999);
                const bool missing = missingRow || (gaps && !wholeRows && channels > 1 && draw.chance(2));
                sample[static_cast<std::size_t>(column.channel)] =
                    missing ? std::numeric_limits<double>::quiet_NaN() : valueOf(mantissa, decimals) * unit.factor;
                row += missing ? draw.of<std::string>({"", "", "nan", "NaN"}) : number(mantissa, decimals);
            }
        }
        line(row);
        const auto ns = static_cast<long long>((static_cast<double>(start + r)) * 1e9 / rate_hz);
        out.t_s.push_back(byRate ? r / rate_hz : static_cast<double>(ns) * 1e-9);
        out.values.insert(out.values.end(), sample.begin(), sample.end());
    }

    out.stream = {{"kind", kind}, {"file", "a.csv"}, {"unit", unit.text}, {"columns", Json::array()}};
    for (int c = 0; c < channels; ++c) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            if (columns[i].channel != c) continue;
            out.stream["columns"].push_back(byName ? Json(columns[i].name) : Json(i + 1));
        }
    }
    for (std::size_t i = 0; i < columns.size() && !byRate; ++i) {
        if (columns[i].channel == -1) out.stream["time_column"] = byName ? Json(columns[i].name) : Json(i + 1);
    }
    if (byRate)
        out.stream["rate_hz"] = rate_hz;
    else
        out.stream["time_unit"] = timeUnit.text;
    if (headed && (!byName || draw.chance(30)))
        out.stream["skip_rows"] = byName ? draw.from(0, lines - 2 > 0 ? 1 : 0) : lines;
    const bool either = comma && !byName && columns.size() == 1;  // the table does not show which the comma is
    if (either || draw.chance(20)) out.stream["decimal"] = comma ? "," : ".";
    const int encoding = draw.from(0, 4);
    out.bytes = encoding == 0   ? text
                : encoding == 4 ? latin1(text)
                : encoding == 1 ? "\xEF\xBB\xBF" + text
                                : utf16(text, encoding == 2);
    out.form = fmt::format("seed {}, {}\n{}", seed, out.stream.dump(), text.substr(0, 600));
    return out;
}

/// Opens a folder with one stream.
Result<Recording> opened(const std::string& bytes, const Json& stream) {
    const ScratchDir folder;
    folder.write("a.csv", bytes);
    folder.write("recording.json", Json{{"streams", {stream}}}.dump());
    return Recording::open(folder.path());
}

Json forceStream(Json more = Json::object()) {
    Json stream{{"kind", "force"}, {"file", "a.csv"}, {"unit", "N"}, {"columns", {1}}};
    stream.update(more);
    return stream;
}

}  // namespace

TEST(RecordingForms, EveryFormOfATableGivesTheNumbersThatWereWritten) {
    RecordProperty("hazard", "H10");
    const auto count = tacto::test::trials<unsigned>({.local = 400, .ci = 2000, .campaign = 20'000});
    for (unsigned seed = 1; seed <= count; ++seed) {
        const auto drawn = drawTable(seed);
        const auto recording = opened(drawn.bytes, drawn.stream);
        ASSERT_TRUE(recording) << recording.error().message << "\n" << drawn.form;
        const auto& stream = recording->streams.at(0);
        ASSERT_EQ(stream.samples.samples(), drawn.t_s.size()) << drawn.form;
        ASSERT_EQ(stream.samples.values.size(), drawn.values.size()) << drawn.form;
        for (std::size_t i = 0; i < drawn.t_s.size(); ++i)
            ASSERT_NEAR(stream.samples.t_s[i], drawn.t_s[i], 1e-9) << "row " << i << ", " << drawn.form;
        std::size_t missing = 0;
        const std::size_t channels = stream.info.channels;
        for (std::size_t i = 0; i < drawn.values.size(); ++i) {
            if (i % channels == 0) {
                const auto at = drawn.values.begin() + static_cast<std::ptrdiff_t>(i);
                missing +=
                    std::any_of(at, at + static_cast<std::ptrdiff_t>(channels), [](double x) { return std::isnan(x); });
            }
            ASSERT_EQ(std::isnan(stream.samples.values[i]), std::isnan(drawn.values[i]))
                << "value " << i << ", " << drawn.form;
            if (std::isnan(drawn.values[i])) continue;
            ASSERT_NEAR(stream.samples.values[i], drawn.values[i], 1e-12 * std::abs(drawn.values[i]))
                << "value " << i << ", " << drawn.form;
        }
        ASSERT_EQ(stream.health.invalidSamples, missing) << drawn.form;
    }
}

TEST(RecordingForms, StreamsOfSeveralRatesInOneTableAreEachReadAtTheirOwn) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Draw draw(seed);
        const int every = draw.from(2, 20);
        std::string text = "time,acc,force\n";
        int forces = 0;
        for (int i = 0; i < 1000; ++i) {
            const bool force = i % every == 0;
            forces += force ? 1 : 0;
            text += fmt::format("{:.3f},{},{}\n", i * 0.001, i, force ? fmt::format("{}", i) : "");
        }
        // The force has its own stamps between those of the acceleration; the table has the rows of both.
        const auto recording =
            opened(text, forceStream({{"time_column", "time"}, {"time_unit", "s"}, {"columns", {"force"}}}));
        ASSERT_TRUE(recording) << recording.error().message;
        const auto& stream = recording->streams.at(0);
        ASSERT_EQ(stream.samples.samples(), static_cast<std::size_t>(forces));
        EXPECT_NEAR(stream.info.rate_hz, 1000.0 / every, 1e-6);
        EXPECT_TRUE(stream.health.continuous()) << stream.health.text();
        for (int i = 0; i < forces; ++i) ASSERT_EQ(stream.samples.values[static_cast<std::size_t>(i)], i * every);
    }
    std::string text = "time,acc,force\n";
    for (int i = 0; i < 200; ++i) {
        text += fmt::format("{:.4f},{},\n", i * 0.001, i);
        if (i % 7 == 3) text += fmt::format("{:.4f},,{}\n", i * 0.001 + 0.0004, i);
    }
    const auto recording = opened(text, {{"kind", "acceleration"},
                                         {"file", "a.csv"},
                                         {"time_column", "time"},
                                         {"time_unit", "s"},
                                         {"columns", {"acc"}},
                                         {"unit", "g"}});
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->streams.at(0).samples.samples(), 200U);
    EXPECT_TRUE(recording->streams.at(0).health.continuous()) << recording->streams.at(0).health.text();
}

TEST(RecordingForms, ARateStandsInPlaceOfTimesAndNotBesideThem) {
    const auto recording = opened("1\n2\n3\n4\n", forceStream({{"rate_hz", 200}}));
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_THAT(recording->streams.at(0).samples.t_s, testing::ElementsAre(0, 0.005, 0.01, 0.015));
    EXPECT_NEAR(recording->streams.at(0).info.rate_hz, 200, 1e-9);
    const auto turned = opened("1\n-2\n3\n", forceStream({{"rate_hz", 200}, {"factor", -0.5}, {"unit", "mN"}}));
    ASSERT_TRUE(turned) << turned.error().message;
    EXPECT_THAT(turned->streams.at(0).samples.values, testing::ElementsAre(-0.0005, 0.001, -0.0015));
    const auto why = [](const std::string& text, const Json& stream) {
        const auto read = opened(text, stream);
        EXPECT_FALSE(read) << stream.dump();
        return read ? std::string() : read.error().message;
    };
    EXPECT_THAT(why("1\n2\n", forceStream()), HasSubstr("neither \"time_column\" nor \"rate_hz\""));
    EXPECT_THAT(why("1\n2\n", forceStream({{"rate_hz", 200}, {"time_column", 1}, {"time_unit", "s"}})),
                HasSubstr("both \"time_column\" and \"rate_hz\""));
    EXPECT_THAT(why("1\n2\n", forceStream({{"rate_hz", 0}})), HasSubstr("\"rate_hz\" is 0"));
    EXPECT_THAT(why("1\n2\n", forceStream({{"rate_hz", 200}, {"factor", 0}})), HasSubstr("\"factor\" is 0"));
    EXPECT_THAT(why("1\n2\n", forceStream({{"time_column", 1}})), HasSubstr("\"time_unit\" is missing"));
    EXPECT_THAT(why("1\n2\n", forceStream({{"rate_hz", 200}, {"columns", {0}}})), HasSubstr("its number from 1"));
    EXPECT_THAT(why("1\n2\n", forceStream({{"rate_hz", 200}, {"columns", {2}}})), HasSubstr("no column 2"));
    EXPECT_THAT(why("1\n2\n", forceStream({{"time_column", "time"}, {"time_unit", "s"}})),
                HasSubstr("\"rate_hz\" stands"));
}

TEST(RecordingForms, ACommaThatMayBeEitherIsAskedFor) {
    const std::string text = "0,25\n-0,5\n1\n2,125\n";
    const auto unknown = opened(text, forceStream({{"rate_hz", 100}}));
    ASSERT_FALSE(unknown);
    EXPECT_THAT(unknown.error().message, HasSubstr("a.csv:1: the comma in each row may be a decimal comma"));
    EXPECT_THAT(unknown.error().message, HasSubstr("\"decimal\""));
    const auto comma = opened(text, forceStream({{"rate_hz", 100}, {"decimal", ","}}));
    ASSERT_TRUE(comma) << comma.error().message;
    EXPECT_THAT(comma->streams.at(0).samples.values, testing::ElementsAre(0.25, -0.5, 1, 2.125));
    const auto two = opened("0,25\n1,5\n2,125\n", forceStream({{"rate_hz", 100}, {"columns", {2}}, {"decimal", "."}}));
    ASSERT_TRUE(two) << two.error().message;
    EXPECT_THAT(two->streams.at(0).samples.values, testing::ElementsAre(25, 5, 125));
    // A header shows how many columns there are.
    const auto named = opened("Kraft\n0,25\n-0,5\n", forceStream({{"rate_hz", 100}, {"columns", {"Kraft"}}}));
    ASSERT_TRUE(named) << named.error().message;
    EXPECT_THAT(named->streams.at(0).samples.values, testing::ElementsAre(0.25, -0.5));
    const auto pair = opened("t,F\n0,25\n1,5\n", forceStream({{"rate_hz", 100}, {"columns", {2}}}));
    ASSERT_TRUE(pair) << pair.error().message;
    EXPECT_THAT(pair->streams.at(0).samples.values, testing::ElementsAre(25, 5));
    // Spreadsheets in countries with decimal commas quote such numbers between commas.
    const auto quoted = opened("t,F\n\"0,00\",\"0,25\"\n\"0,01\",\"-0,5\"\n",
                               forceStream({{"time_column", "t"}, {"time_unit", "s"}, {"columns", {"F"}}}));
    ASSERT_TRUE(quoted) << quoted.error().message;
    EXPECT_THAT(quoted->streams.at(0).samples.values, testing::ElementsAre(0.25, -0.5));
}

TEST(RecordingForms, UnitsBelowTheHeaderThatContradictTheDescriptionAreRefused) {
    RecordProperty("hazard", "H10");
    const auto read = [](const std::string& units, const char* timeUnit, const char* unit) {
        return opened(
            "time,force\n" + units + "\n0,1\n0.01,2\n",
            forceStream({{"time_column", "time"}, {"time_unit", timeUnit}, {"columns", {"force"}}, {"unit", unit}}));
    };
    EXPECT_TRUE(read("s,N", "s", "N"));
    EXPECT_TRUE(read("(ms),(mN)", "ms", "mN"));
    const auto milli = read("s,mN", "s", "N");
    ASSERT_FALSE(milli);
    EXPECT_THAT(milli.error().message, HasSubstr("a.csv:2: column \"force\" is in mN by the line below the header"));
    const auto slow = read("ms,N", "s", "N");
    ASSERT_FALSE(slow);
    EXPECT_THAT(slow.error().message, HasSubstr("a.csv:2: column \"time\" is in ms"));
}
