#include "tests/formats/WrittenTables.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <fmt/chrono.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

namespace tacto::test {

namespace {

template <class T, std::size_t kSize>
const T& oneOf(const std::array<T, kSize>& all, Random& random) {
    return all[random.below(kSize)];
}
bool chance(Random& random, double share) { return random.uniform() < share; }

std::string replaceAll(std::string text, std::string_view what, std::string_view by) {
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
        text.replace(at, what.size(), by);
    }
    return text;
}

struct Spelling {
    std::string_view text;
    std::string_view unit;
    double factor;
};
constexpr std::array<Spelling, 8> kTimes{{{"s", "s", 1},
                                          {"ms", "s", 1e-3},
                                          {"us", "s", 1e-6},
                                          {"µs", "s", 1e-6},
                                          {"μs", "s", 1e-6},
                                          {"ns", "s", 1e-9},
                                          {"sec", "s", 1},
                                          {"milliseconds", "s", 1e-3}}};
constexpr std::array<Spelling, 10> kSignals{{{"V", "V", 1},
                                             {"mV", "V", 1e-3},
                                             {"µV", "V", 1e-6},
                                             {"kV", "V", 1e3},
                                             {"Volt", "V", 1},
                                             {"V DC", "V", 1},
                                             {"A", "A", 1},
                                             {"mA", "A", 1e-3},
                                             {"μA", "A", 1e-6},
                                             {"Amps", "A", 1}}};

/// The way in which a table writes its numbers and separates its columns.
struct Hand {
    char separator;
    char point;
    bool shortens = false;  ///< omits zeros at the end, as spreadsheets do
};
Hand someHand(Random& random) {
    constexpr std::array<Hand, 5> kHands{
        {{',', '.', false}, {';', '.', false}, {';', ',', false}, {'\t', '.', false}, {'\t', ',', false}}};
    auto hand = oneOf(kHands, random);
    hand.shortens = chance(random, 0.4);
    return hand;
}

/// A number as text, and the value of this text.
class Number {
public:
    Number(double value, int digits, Hand hand, bool scientific = false)
        : text_(scientific ? fmt::format("{:.{}e}", value, digits) : fmt::format("{:.{}f}", value, digits)), value_(0) {
        std::from_chars(text_.data(), text_.data() + text_.size(), value_);
        if (hand.shortens && !scientific) {
            while (text_.ends_with('0') && text_.find('.') != std::string::npos) text_.pop_back();
            if (text_.ends_with('.')) text_.pop_back();
        }
        if (hand.point == ',') text_ = replaceAll(text_, ".", ",");
    }
    [[nodiscard]] const std::string& text() const { return text_; }
    [[nodiscard]] double value() const { return value_; }

private:
    std::string text_;
    double value_;
};

std::string line(const std::vector<std::string>& fields, Hand hand) {
    return fmt::format("{}\n", fmt::join(fields, std::string(1, hand.separator)));
}

/// Evenly spaced times. `step` and `start` are in the unit of their column and multiples of its last digit.
struct Times {
    double step;
    double start;
    int digits;
};
Times someTimes(Random& random) {
    constexpr std::array<double, 4> kSteps{1, 0.5, 0.02, 0.004};
    const double step = oneOf(kSteps, random);
    const auto first = static_cast<double>(random.below(200));
    return {step, step * (first - 100), 3};
}

std::size_t someRows(Random& random) { return 3 + random.below(60); }

/// Fills channels with random values of `digits` digits. Returns `text[channel][row]`.
std::vector<std::vector<std::string>> fillChannels(WrittenTable& table, std::size_t rows, Hand hand, Random& random,
                                                   const std::vector<double>& factors) {
    std::vector<std::vector<std::string>> texts(table.channels.size());
    for (std::size_t c = 0; c < table.channels.size(); ++c) {
        const bool scientific = chance(random, 0.3);
        for (std::size_t i = 0; i < rows; ++i) {
            const Number number(20 * random.uniform() - 10, 4, hand, scientific);
            texts[c].push_back(number.text());
            table.channels[c].values.push_back(number.value() * factors[c]);
        }
    }
    return texts;
}

/// Returns a name with its unit: "CH1 (mV)", "U/V", "CH1_mv" …, in the table's `style`.
std::string named(std::string_view name, std::string_view unit, std::uint64_t style) {
    const std::string lower = replaceAll(replaceAll(std::string(unit), "µ", "u"), "μ", "u");
    switch (style) {
        case 0:
            return fmt::format("{} ({})", name, unit);
        case 1:
            return fmt::format("{}[{}]", name, unit);
        case 2:
            return fmt::format("{}/{}", name, unit);
        case 3:
            return fmt::format("{} / {}", name, unit);
        case 4:
            return fmt::format("{} in {}", name, unit);
        case 5:
            return fmt::format("{}_{}", name, lower);
        case 6:
            return fmt::format("{} (Unit: {})", name, unit);
        default:
            return std::string(name);  // the unit is in a line below
    }
}

/// Writes a row with keys in columns 1 and 2, and time and value in columns 4 and 5.
std::string besideKeys(const std::vector<std::pair<std::string, std::string>>& keys, std::size_t row, Hand hand,
                       const std::string& time, const std::string& value) {
    const auto& [key, what] = row < keys.size() ? keys[row] : std::pair<std::string, std::string>();
    return line({key, what, "", " " + time, "  " + value}, hand);
}

}  // namespace

std::string inSomeEncoding(const std::string& text, Random& random) {
    auto written = chance(random, 0.5) ? replaceAll(text, "\n", "\r\n") : text;
    switch (random.below(4)) {
        case 0:
            return "\xEF\xBB\xBF" + written;
        case 1: {  // Latin-1, if it has all characters
            if (written.find("μ") != std::string::npos) return written;
            return replaceAll(replaceAll(written, "µ", "\xB5"), "°", "\xB0");
        }
        case 2: {  // UTF-16
            const bool big = chance(random, 0.5);
            std::string wide = big ? "\xFE\xFF" : "\xFF\xFE";
            for (std::size_t i = 0; i < written.size();) {
                const auto byte = static_cast<unsigned char>(written[i]);
                if (byte >= 0xE0) return written;  // three-byte characters are not worth a conversion here
                const unsigned code =
                    byte < 0x80 ? byte : (byte & 0x1FU) << 6U | (static_cast<unsigned char>(written[i + 1]) & 0x3FU);
                i += byte < 0x80 ? 1 : 2;
                const auto high = static_cast<char>(code >> 8U);
                const auto low = static_cast<char>(code & 0xFFU);
                wide += big ? high : low;
                wide += big ? low : high;
            }
            return wide;
        }
        default:
            return written;
    }
}

WrittenTable plainTable(Random& random) {
    WrittenTable table;
    const auto hand = someHand(random);
    const auto times = someTimes(random);
    const auto rows = someRows(random);
    const auto style = random.below(8);
    const auto& unit = oneOf(kTimes, random);
    constexpr std::array<std::string_view, 5> kTimeNames{"t", "Time", "Zeit", "time since trigger", "Temps"};
    table.format = "csv";
    table.rate_hz = 1 / (times.step * unit.factor);
    table.start_s = times.start * unit.factor;
    std::vector<double> factors;
    std::vector<std::string> names{named(oneOf(kTimeNames, random), unit.text, style)};
    std::vector<std::string> units{fmt::format("[{}]", unit.text)};
    for (std::size_t c = 0; c < 1 + random.below(3); ++c) {
        const auto& signal = oneOf(kSignals, random);
        constexpr std::array<std::string_view, 3> kNames{"CH", "U", "Kanal "};
        table.channels.push_back({fmt::format("{}{}", kNames[c], c + 1), std::string(signal.unit), {}});
        factors.push_back(signal.factor);
        names.push_back(named(table.channels.back().name, signal.text, style));
        units.push_back(fmt::format("[{}]", signal.text));
    }
    auto texts = fillChannels(table, rows, hand, random, factors);
    const bool hasOther = style != 5 && chance(random, 0.4);
    if (hasOther) {
        constexpr std::array<std::string_view, 5> kOthers{"°C", "Hz", "%", "kPa", "N"};
        const auto other = oneOf(kOthers, random);
        names.push_back(named("other", other, style));
        units.push_back(fmt::format("[{}]", other));
        table.leftOut.push_back(names.back());
    }
    const bool hasText = style != 7 && chance(random, 0.3);
    if (hasText) table.leftOut.emplace_back("note");
    const bool hasNumbers = style != 7 && chance(random, 0.2);
    if (hasNumbers) table.leftOut.emplace_back("Sample");
    if (hasNumbers) names.insert(names.begin(), "Sample");
    if (hasText) names.emplace_back("note");
    std::string text = chance(random, 0.3) ? "made by hand\n" : "";
    text += line(names, hand);
    if (style == 7) text += line(units, hand);
    for (std::size_t i = 0; i < rows; ++i) {
        std::vector<std::string> fields;
        if (hasNumbers) fields.push_back(fmt::to_string(i));
        fields.push_back(Number(times.start + static_cast<double>(i) * times.step, times.digits, hand).text());
        for (const auto& channel : texts) fields.push_back(channel[i]);
        if (hasOther) fields.push_back(Number(20 + random.uniform(), 1, hand).text());
        if (hasText) fields.emplace_back(chance(random, 0.5) ? "ok" : "a word");
        text += line(fields, hand);
    }
    table.text = inSomeEncoding(text, random);
    return table;
}

WrittenTable tektronixBesideKeys(Random& random) {
    WrittenTable table;
    const Hand hand{',', '.', false};
    constexpr std::array<std::string_view, 5> kSources{"CH1", "CH2", "CH4", "MATH", "REFA"};
    constexpr std::array<Spelling, 4> kUnits{{{"V", "V", 1}, {"mV", "V", 1e-3}, {"A", "A", 1}, {"Volts", "V", 1}}};
    const auto& unit = oneOf(kUnits, random);
    const auto rows = 20 + random.below(40);
    table.format = "csv-tektronix";
    table.rate_hz = 1 / 2e-7;
    table.start_s = -5e-6;
    table.channels.push_back({std::string(oneOf(kSources, random)), std::string(unit.unit), {}});
    const auto texts = fillChannels(table, rows, hand, random, {unit.factor});
    std::vector<std::pair<std::string, std::string>> keys{
        {"Record Length", fmt::format("{:e}", static_cast<double>(rows))},
        {"Sample Interval", "2.000000e-07"},
        {"Trigger Point", "1.0e+01"}};
    for (auto empty = random.below(5); empty > 0; --empty) keys.emplace_back("", "");
    keys.emplace_back("Source", table.channels[0].name);
    if (chance(random, 0.5)) keys.emplace_back("", "");
    keys.emplace_back("Vertical Units", std::string(unit.text));
    keys.emplace_back("Vertical Scale", "1.000000e+01");
    keys.emplace_back("Horizontal Units", "s");
    keys.emplace_back("Probe Atten", "1.0e+01");
    std::string text;
    for (std::size_t i = 0; i < rows; ++i) {
        const auto time = fmt::format("{:.12f}", table.start_s + static_cast<double>(i) * 2e-7);
        auto row = besideKeys(keys, i, hand, time, texts[0][i]);
        if (rows % 2 == 0) row.insert(row.size() - 1, ",");
        text += row;
    }
    table.text = inSomeEncoding(text, random);
    return table;
}

WrittenTable gwInstekWithoutMode(Random& random) {
    WrittenTable table;
    const auto rows = someRows(random);
    const auto traces = 1 + random.below(2);
    table.format = "csv-gwinstek";
    table.rate_hz = 250e3;
    table.start_s = -1.32e-3 - static_cast<double>(rows) / 2 / 250e3;
    std::string keys[5] = {"", "", "", "", ""};
    std::vector<double> scales;
    for (std::uint64_t k = 0; k < traces; ++k) {
        constexpr std::array<double, 4> kScales{0.5, 2, 0.02, 10};
        scales.push_back(oneOf(kScales, random));
        const bool isCurrent = chance(random, 0.2);
        table.channels.push_back({fmt::format("CH{}", k + 1), isCurrent ? "A" : "V", {}});
        keys[0] += fmt::format("Memory Length,{},", rows);
        keys[1] += fmt::format("Source,CH{},", k + 1);
        keys[2] += fmt::format("Vertical Units,{},", isCurrent ? "A" : "V");
        keys[3] += fmt::format("Vertical Scale,{:.3E},", scales.back());
        keys[4] += "Sampling Period,4.000E-06,";
    }
    std::string text = keys[0] + "\nTrigger Level,4.6E-01,\n" + keys[1] + "\n" + keys[2] + "\n" + keys[3] +
                       "\nHorizontal Units,s,\nHorizontal Scale,1.0E-03,\nHorizontal Position,-1.320E-03,\n"
                       "Horizontal Mode,Main,\n" +
                       keys[4] + "\nFirmware, V1.12,\nWaveform Data,\n";
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t k = 0; k < traces; ++k) {
            const int code = static_cast<int>(random.below(200)) - 100;
            text += fmt::format("{},{}", code, k + 1 < traces ? "," : "");
            table.channels[k].values.push_back(code * scales[k] / 25);
        }
        text += "\n";
    }
    table.text = inSomeEncoding(text, random);
    return table;
}

WrittenTable rigolWithoutIndex(Random& random) {
    WrittenTable table;
    const Hand hand{',', '.', false};
    const auto rows = someRows(random);
    table.format = "csv-rigol";
    table.rate_hz = 100e3;
    table.start_s = -6e-3;
    std::string names;
    std::string units;
    for (std::size_t c = 0; c < 1 + random.below(4); ++c) {
        const bool isCurrent = chance(random, 0.2);
        table.channels.push_back({fmt::format("CH{}", c + 1), isCurrent ? "A" : "V", {}});
        names += fmt::format("CH{},", c + 1);
        units += isCurrent ? "Ampere," : "Volt,";
    }
    const auto texts = fillChannels(table, rows, hand, random, std::vector<double>(table.channels.size(), 1));
    std::string text = names + "Start,Increment,\n" + units + "-6.00000e-03,1.00000e-05\n";
    for (std::size_t i = 0; i < rows; ++i) {
        for (const auto& channel : texts) text += channel[i] + ",";
        text += "\n";
    }
    table.text = inSomeEncoding(text, random);
    return table;
}

WrittenTable dsViewOscilloscope(Random& random) {
    WrittenTable table;
    const Hand hand{',', '.', false};
    const auto rows = someRows(random);
    struct Rate {
        std::string_view text;
        double hz;
    };
    constexpr std::array<Rate, 4> kRates{{{"100 kHz", 1e5}, {"1 MHz", 1e6}, {"2.5 MHz", 2.5e6}, {"500 Hz", 500}}};
    const auto& rate = oneOf(kRates, random);
    table.format = "csv";
    table.rate_hz = rate.hz;
    std::vector<double> factors;
    std::string names;
    for (std::size_t c = 0; c < 1 + random.below(2); ++c) {
        constexpr std::array<Spelling, 3> kUnits{{{"mV", "V", 1e-3}, {"V", "V", 1}, {"kV", "V", 1e3}}};
        const auto& unit = oneOf(kUnits, random);
        table.channels.push_back({fmt::format("CH{}", c), "V", {}});
        factors.push_back(unit.factor);
        names += fmt::format("{} CH{} (Unit: {})", c == 0 ? "" : ",", c, unit.text);
    }
    const auto texts = fillChannels(table, rows, hand, random, factors);
    std::string text = fmt::format(
        "; CSV, generated by libsigrok4DSL 0.2.0 on Wed Jul 24 18:28:57 2024\n; Channels ({}/{})\n; Sample rate: {}\n"
        "; Sample count: {} Samples\n{}\n",
        table.channels.size(), table.channels.size(), rate.text, rows, names);
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t c = 0; c < texts.size(); ++c) text += (c == 0 ? "" : ",") + texts[c][i];
        text += "\n";
    }
    table.text = inSomeEncoding(text, random);
    return table;
}

WrittenTable picoScopeOfSomeLanguage(Random& random) {
    WrittenTable table;
    const auto hand = someHand(random);
    const auto times = someTimes(random);
    const auto rows = someRows(random);
    struct Words {
        std::string_view time, channel;
    };
    constexpr std::array<Words, 6> kWords{{{"Time", "Channel"},
                                           {"Zeit", "Kanal"},
                                           {"Temps", "Voie"},
                                           {"Temps", "Canal"},
                                           {"Tiempo", "Canal"},
                                           {"Tempo", "Canale"}}};
    const auto& words = oneOf(kWords, random);
    constexpr std::array<Spelling, 4> kPicoTimes{
        {{"s", "s", 1}, {"ms", "s", 1e-3}, {"µs", "s", 1e-6}, {"ns", "s", 1e-9}}};
    constexpr std::array<Spelling, 4> kPicoUnits{{{"V", "V", 1}, {"mV", "V", 1e-3}, {"µV", "V", 1e-6}, {"A", "A", 1}}};
    const auto& time = oneOf(kPicoTimes, random);
    table.format = "csv-picoscope";
    table.rate_hz = 1 / (times.step * time.factor);
    table.start_s = times.start * time.factor;
    std::vector<double> factors;
    std::vector<std::string> names{std::string(words.time)};
    std::vector<std::string> units{fmt::format("({})", time.text)};
    for (std::size_t c = 0; c < 1 + random.below(3); ++c) {
        const auto& unit = oneOf(kPicoUnits, random);
        table.channels.push_back(
            {fmt::format("{} {}", words.channel, static_cast<char>('A' + c)), std::string(unit.unit), {}});
        factors.push_back(unit.factor);
        names.push_back(table.channels.back().name);
        units.push_back(fmt::format("({})", unit.text));
    }
    const auto texts = fillChannels(table, rows, hand, random, factors);
    std::string text = line(names, hand) + line(units, hand) + "\n";
    for (std::size_t i = 0; i < rows; ++i) {
        std::vector<std::string> fields{Number(times.start + static_cast<double>(i) * times.step, 3, hand).text()};
        for (const auto& channel : texts) fields.push_back(channel[i]);
        text += line(fields, hand);
    }
    table.text = inSomeEncoding(text, random);
    return table;
}

WrittenTable rohdeSchwarz(Random& random) {
    WrittenTable table;
    const Hand hand{',', '.', false};
    const auto rows = someRows(random);
    table.format = "csv";
    table.rate_hz = 1e6;
    table.start_s = -1e-5;
    const bool hameg = chance(random, 0.3);
    std::string names = hameg ? "[s]" : chance(random, 0.5) ? "in s" : "time in s";
    std::vector<double> factors;
    for (std::size_t c = 0; c < 1 + random.below(4); ++c) {
        constexpr std::array<Spelling, 3> kUnits{{{"V", "V", 1}, {"mA", "A", 1e-3}, {"A", "A", 1}}};
        const auto& unit = oneOf(kUnits, random);
        table.channels.push_back({fmt::format("{}{}", hameg ? "CH" : "C", c + 1), std::string(unit.unit), {}});
        factors.push_back(unit.factor);
        names += fmt::format(fmt::runtime(hameg ? ",{}[{}]" : ",{} in {}"), table.channels.back().name, unit.text);
    }
    const auto texts = fillChannels(table, rows, hand, random, factors);
    std::string text = names + "\n";
    for (std::size_t i = 0; i < rows; ++i) {
        text += fmt::format("{:.7E}", -1e-5 + 1e-6 * static_cast<double>(i));
        for (const auto& channel : texts) text += "," + channel[i];
        text += "\n";
    }
    table.text = inSomeEncoding(text, random);
    return table;
}

WrittenTable timesForEachChannel(Random& random) {
    WrittenTable table;
    const auto hand = someHand(random);
    const auto times = someTimes(random);
    const auto rows = someRows(random);
    const bool sameNames = chance(random, 0.5);
    const auto& unit = oneOf(kTimes, random);
    table.format = "csv";
    table.rate_hz = 1 / (times.step * unit.factor);
    table.start_s = times.start * unit.factor;
    std::vector<double> factors;
    std::vector<std::string> names;
    for (std::size_t c = 0; c < 2 + random.below(2); ++c) {
        const auto& signal = oneOf(kSignals, random);
        table.channels.push_back({fmt::format("CH{}", c + 1), std::string(signal.unit), {}});
        factors.push_back(signal.factor);
        names.push_back(sameNames ? fmt::format("Time ({})", unit.text)
                                  : fmt::format("Time_CH{} ({})", c + 1, unit.text));
        names.push_back(fmt::format("CH{} ({})", c + 1, signal.text));
    }
    const auto texts = fillChannels(table, rows, hand, random, factors);
    std::string text = line(names, hand);
    for (std::size_t i = 0; i < rows; ++i) {
        std::vector<std::string> fields;
        for (const auto& channel : texts) {
            fields.push_back(Number(times.start + static_cast<double>(i) * times.step, 3, hand).text());
            fields.push_back(channel[i]);
        }
        text += line(fields, hand);
    }
    table.text = inSomeEncoding(text, random);
    return table;
}

WrittenTable stampedTable(Random& random) {
    WrittenTable table;
    const auto hand = someHand(random);
    const auto rows = someRows(random);
    constexpr std::array<int, 4> kSteps_us{1000, 20, 250'000, 5'000'000};
    const auto step_us = oneOf(kSteps_us, random);
    constexpr std::array<std::string_view, 4> kNames{"timestamp", "time", "Datum", "when"};
    table.format = "csv";
    table.rate_hz = 1e6 / step_us;
    const auto& signal = oneOf(kSignals, random);
    table.channels.push_back({"CH1", std::string(signal.unit), {}});
    const auto texts = fillChannels(table, rows, hand, random, {signal.factor});
    constexpr std::array<std::string_view, 5> kZones{"", "Z", "+01:00", "-0530", "+14"};
    const auto zone = oneOf(kZones, random);
    const char between = chance(random, 0.5) ? 'T' : ' ';
    const bool timeOnly = zone.empty() && chance(random, 0.3);
    // The dates pass midnight and the end of a year.
    const auto begin = std::chrono::sys_days(std::chrono::year(2026) / 12 / 31) +
                       std::chrono::microseconds((timeOnly ? 3'600'000'000LL : 86'399'000'000LL) +
                                                 static_cast<long long>(random.below(900'000)));
    table.start_s = static_cast<double>(begin.time_since_epoch().count() % 1'000'000) * 1e-6;
    std::string text = line({std::string(oneOf(kNames, random)), fmt::format("CH1 ({})", signal.text)}, hand);
    for (std::size_t i = 0; i < rows; ++i) {
        const auto at = begin + std::chrono::microseconds(static_cast<long long>(i) * step_us);
        const auto whole = std::chrono::floor<std::chrono::seconds>(at);
        const auto stamp = fmt::format("{}{}{:06}{}",
                                       timeOnly ? fmt::format("{:%H:%M:%S}", whole)
                                                : fmt::format("{:%Y-%m-%d}{}{:%H:%M:%S}", whole, between, whole),
                                       hand.point, (at - whole).count(), zone);
        text += line({stamp, texts[0][i]}, hand);
    }
    table.text = inSomeEncoding(text, random);
    return table;
}

WrittenTable anyWrittenTable(Random& random) {
    constexpr std::array kTables{plainTable,        tektronixBesideKeys, gwInstekWithoutMode,
                                 rigolWithoutIndex, dsViewOscilloscope,  picoScopeOfSomeLanguage,
                                 rohdeSchwarz,      timesForEachChannel, stampedTable};
    return kTables[random.below(kTables.size())](random);
}

void expectAsWritten(const Result<CaptureReading>& read, const WrittenTable& table) {
    ASSERT_TRUE(read) << read.error().message << "\n" << table.text;
    EXPECT_EQ(read->formatId, table.format) << table.text;
    EXPECT_NEAR(read->capture.rate_hz / table.rate_hz, 1, 1e-6) << table.text;
    EXPECT_NEAR(read->capture.start_s, table.start_s, 1e-3 / table.rate_hz) << table.text;
    ASSERT_EQ(read->capture.channels.size(), table.channels.size()) << table.text;
    for (std::size_t c = 0; c < table.channels.size(); ++c) {
        const auto& channel = read->capture.channels[c];
        const auto& written = table.channels[c];
        EXPECT_EQ(channel.name, written.name) << table.text;
        EXPECT_EQ(channel.unit, written.unit) << table.text;
        ASSERT_EQ(channel.samples.size(), written.values.size()) << table.text;
        for (std::size_t i = 0; i < written.values.size(); ++i) {
            ASSERT_FLOAT_EQ(channel.samples[i], static_cast<float>(written.values[i])) << i << "\n" << table.text;
        }
    }
    for (const auto& name : table.leftOut) {
        EXPECT_THAT(read->warnings, ::testing::Contains(::testing::AllOf(::testing::HasSubstr(name),
                                                                         ::testing::HasSubstr("was left out"))))
            << table.text;
    }
}

}  // namespace tacto::test
