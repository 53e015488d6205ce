#include <cstdlib>
#include <cstring>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <unistd.h>

#include "core/formats/TextBlocks.h"
#include "drivers/sigrok/session_file/SigrokFormat.h"
#include "tests/drivers/sigrok/ZipWriter.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class SrFile : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] fs::path at(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] Result<CaptureReading> read(const std::string& name, const ReadOptions& options = {},
                                              const ReadWatch& watch = {}) const {
        return format_.read(at(name), options, watch);
    }
    /// Expects an error that names the file and contains `what`.
    void expectRefused(const std::string& name, const std::string& what) const {
        EXPECT_THAT(read(name), refused(ErrorCode::ParseError, testing::AllOf(HasSubstr(name), HasSubstr(what))))
            << name;
    }

    const fs::path folder_ = fs::temp_directory_path() / fmt::format("tacto-sr-{}", ::getpid());
    const SigrokFormat format_;
};

Capture twoChannels(std::size_t samples, double rate) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> values(-12, 12);
    Capture capture;
    capture.rate_hz = rate;
    for (const auto& [name, unit] : {std::pair("voltage", "V"), std::pair("current", "A")}) {
        auto& channel = capture.channels.emplace_back();
        channel.name = name;
        channel.unit = unit;
        for (std::size_t i = 0; i < samples; ++i) channel.samples.push_back(values(random));
    }
    return capture;
}

std::string metadata(const std::string& device) { return "[global]\nsigrok version=0.5.2\n\n[device 1]\n" + device; }

std::string floats(std::size_t count, float value = 1.5F) {
    const std::vector<float> samples(count, value);
    std::string bytes(count * sizeof(float), '\0');
    std::memcpy(bytes.data(), samples.data(), bytes.size());
    return bytes;
}

TEST_F(SrFile, TheRealOscilloscopesCaptureAgreesWithItsCsv) {
    const fs::path data = test::sourceDir() / "../shared/data/scope/mdo4104c";
    if (!fs::exists(data / "RTC.sr")) GTEST_SKIP() << "no shared data here";
    const auto sr = accepted(format_.read(data / "RTC.sr", {}, {}));
    EXPECT_DOUBLE_EQ(sr.capture.rate_hz, 50e6);
    ASSERT_EQ(sr.capture.channels.size(), 2U);
    EXPECT_EQ(sr.capture.channels[0].name, "SDA");
    EXPECT_EQ(sr.capture.channels[1].name, "SCL");
    ASSERT_EQ(sr.capture.samples(), 100'000U);
    // The instrument's own table: TIME,CH1,CH2 after the header.
    std::ifstream csv(data / "RTC.csv");
    std::string line;
    while (std::getline(csv, line) && !line.starts_with("TIME")) {
    }
    double worst = 0;
    std::size_t row = 0;
    for (; std::getline(csv, line) && line.size() > 2; ++row) {
        ASSERT_LT(row, 100'000U);
        const char* at = line.c_str();
        char* end = nullptr;
        (void)std::strtod(at, &end);
        for (std::size_t c = 0; c < 2; ++c) {
            const double value = std::strtod(end + 1, &end);
            worst = std::max(worst, std::abs(value - static_cast<double>(sr.capture.channels[c].samples[row])));
        }
    }
    EXPECT_EQ(row, 100'000U);
    EXPECT_LE(worst, 2.3e-7);
}

TEST_F(SrFile, WhatIsWrittenReturnsBitByBit) {
    const auto capture = twoChannels(100'000, 999'983);
    ASSERT_TRUE(format_.write(at("two.sr"), capture).has_value());
    const auto reading = accepted(read("two.sr"));
    EXPECT_TRUE(reading.warnings.empty());
    EXPECT_DOUBLE_EQ(reading.capture.rate_hz, 999'983);
    ASSERT_EQ(reading.capture.channels.size(), 2U);
    for (std::size_t c = 0; c < 2; ++c) {
        EXPECT_EQ(reading.capture.channels[c].name, capture.channels[c].name);
        EXPECT_EQ(reading.capture.channels[c].unit, capture.channels[c].unit);
        EXPECT_EQ(reading.capture.channels[c].samples, capture.channels[c].samples);
    }
    EXPECT_FALSE(fs::exists(at("two.sr.part")));
}

TEST_F(SrFile, LogicAndAnalogChannelsReturnTogether) {
    Capture capture;
    capture.rate_hz = 1e6;
    for (int c = 0; c < 10; ++c) {
        auto& channel = capture.channels.emplace_back();
        channel.name = fmt::format("D{}", c);
        for (int i = 0; i < 5000; ++i) channel.samples.push_back((i * (c + 3) / 7) % 2 == 0 ? 0.0F : 1.0F);
    }
    auto& volts = capture.channels.emplace_back();
    volts.name = "out";
    volts.unit = "V";
    for (int i = 0; i < 5000; ++i) volts.samples.push_back(0.25F * static_cast<float>(i % 40));
    ASSERT_TRUE(format_.write(at("mixed.sr"), capture).has_value());
    const auto reading = accepted(read("mixed.sr"));
    ASSERT_EQ(reading.capture.channels.size(), 11U);
    for (std::size_t c = 0; c < 11; ++c) {
        EXPECT_EQ(reading.capture.channels[c].name, capture.channels[c].name);
        EXPECT_EQ(reading.capture.channels[c].unit, capture.channels[c].unit);
        EXPECT_EQ(reading.capture.channels[c].samples, capture.channels[c].samples) << c;
    }
}

TEST_F(SrFile, SigrokCliReadsTheSameValues) {
    if (std::system("command -v sigrok-cli >/dev/null") != 0) GTEST_SKIP() << "sigrok-cli is not installed";
    const auto capture = twoChannels(3000, 2e6);
    ASSERT_TRUE(format_.write(at("cli.sr"), capture).has_value());
    const auto wav =
        fmt::format("sigrok-cli -i {} -O wav:scale=1 -o {}", at("cli.sr").string(), at("cli.wav").string());
    ASSERT_EQ(std::system(wav.c_str()), 0);
    std::ifstream file(at("cli.wav"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const std::size_t data = bytes.find("data");
    ASSERT_NE(data, std::string::npos);
    std::vector<float> frames((bytes.size() - data - 8) / sizeof(float));
    std::memcpy(frames.data(), bytes.data() + data + 8, frames.size() * sizeof(float));
    ASSERT_GE(frames.size(), 6000U);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < 3000; ++i) {
        for (std::size_t c = 0; c < 2; ++c) differing += frames[2 * i + c] != capture.channels[c].samples[i] ? 1U : 0U;
    }
    EXPECT_EQ(differing, 0U);
}

TEST_F(SrFile, OptionsNameUnitsProbesColumnsAndRate) {
    ASSERT_TRUE(format_.write(at("o.sr"), twoChannels(100, 1e6)).has_value());
    ReadOptions options;
    options.columns = {"current"};
    options.units["current"] = "mA";
    options.rate = Hertz(5e5);
    const auto reading = accepted(read("o.sr", options));
    ASSERT_EQ(reading.capture.channels.size(), 1U);
    EXPECT_EQ(reading.capture.channels[0].unit, "A");
    EXPECT_DOUBLE_EQ(reading.capture.rate_hz, 5e5);
    options.columns = {"nothing"};
    EXPECT_EQ(read("o.sr", options).error().code, ErrorCode::InvalidArgument);
}

TEST_F(SrFile, ProgressRisesAndAStopEndsIt) {
    ASSERT_TRUE(format_.write(at("p.sr"), twoChannels(3'000'000, 1e6)).has_value());
    std::vector<double> seen;
    ReadWatch watch;
    watch.progress = [&](double fraction) { seen.push_back(fraction); };
    ASSERT_TRUE(read("p.sr", {}, watch).has_value());
    ASSERT_GT(seen.size(), 4U);
    EXPECT_TRUE(std::ranges::is_sorted(seen));
    EXPECT_DOUBLE_EQ(seen.back(), 1);
    std::stop_source stop;
    watch.stop = stop.get_token();
    watch.progress = [&](double fraction) {
        if (fraction > 0.3) stop.request_stop();
    };
    EXPECT_THAT(read("p.sr", {}, watch), refused(ErrorCode::Stopped));
    EXPECT_TRUE(read("p.sr").has_value()) << "and again";
}

TEST_F(SrFile, IsRecognisedByItsBeginning) {
    ASSERT_TRUE(format_.write(at("r.sr"), twoChannels(100, 1e6)).has_value());
    const auto head = readHead(at("r.sr"));
    EXPECT_TRUE(format_.recognises("r.sr", *head));
    EXPECT_TRUE(format_.recognises("renamed.bin", *head));
    EXPECT_FALSE(format_.recognises("table.sr", "time,voltage\n0,1\n1,2\n and more text than a header"));
    EXPECT_FALSE(format_.recognises("other.zip", zipOf({{"document.xml", std::string(100, 'x')}})));
    EXPECT_FALSE(format_.recognises("x.sr", "PK"));
}

TEST_F(SrFile, WhatMakesNoSenseIsRefused) {
    const auto put = [&](const std::string& name, const std::string& bytes) {
        std::ofstream(at(name), std::ios::binary) << bytes;
    };
    const std::pair<std::string, std::string> version{"version", "2"};
    const auto analog = metadata("samplerate=1 MHz\ntotal analog=1\nanalog1=A0\n");
    put("empty.sr", "");
    expectRefused("empty.sr", "directory");
    put("text.sr", "time,voltage\n0,1\n");
    expectRefused("text.sr", "directory");
    put("other.sr", zipOf({{"hello", "world"}}));
    expectRefused("other.sr", "sigrok session");
    put("version.sr", zipOf({{"version", "7"}, {"metadata", analog}, {"analog-1-1-1", floats(10)}}));
    expectRefused("version.sr", "version 7");
    put("none.sr", zipOf({version, {"metadata", analog}}));
    expectRefused("none.sr", "no samples");
    put("odd.sr", zipOf({version, {"metadata", analog}, {"analog-1-1-1", floats(10) + "x"}}));
    expectRefused("odd.sr", "41 bytes");
    put("channels.sr", zipOf({version, {"metadata", metadata("samplerate=1 MHz\ntotal analog=99999999\n")}}));
    expectRefused("channels.sr", "channels");
    put("unit.sr", zipOf({version,
                          {"metadata", metadata("capturefile=logic-1\ntotal probes=8\nsamplerate=1 MHz\nprobe1=D0\n")},
                          {"logic-1-1", std::string(100, 'x')}}));
    expectRefused("unit.sr", "unitsize is 0");
    put("two.sr", zipOf({version, {"metadata", analog + "[device 2]\n"}, {"analog-1-1-1", floats(10)}}));
    expectRefused("two.sr", "one device");
    put("one.sr", zipOf({version, {"metadata", analog}, {"analog-1-1-1", floats(1)}}));
    expectRefused("one.sr", "at least 2");
    put("rate.sr",
        zipOf({version, {"metadata", metadata("total analog=1\nanalog1=A0\n")}, {"analog-1-1-1", floats(9)}}));
    expectRefused("rate.sr", "sampling rate");
    auto bytes = zipOf({version, {"metadata", analog}, {"analog-1-1-1", floats(1000)}});
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x10);
    put("damaged.sr", bytes);
    expectRefused("damaged.sr", "damaged");
    bytes = zipOf({version, {"metadata", analog}, {"analog-1-1-1", floats(10)}});
    bytes.replace(bytes.rfind("PK\1\2") + 24, 4, "\xF0\xFF\xFF\x7F");
    put("forged.sr", bytes);
    expectRefused("forged.sr", "cannot be unpacked to 2147483632 bytes");
    EXPECT_EQ(read("absent.sr").error().code, ErrorCode::NotFound);
}

TEST_F(SrFile, ASamplingRateThatIsNoneIsRefusedUnlessTheUserGivesOne) {
    // libsigrok reads "-1 MHz" as 18 exahertz.
    const auto put = [&](const std::string& rate) {
        std::ofstream(at("rate.sr"), std::ios::binary)
            << zipOf({{"version", "2"},
                      {"metadata", metadata("samplerate=" + rate + "\ntotal analog=1\nanalog1=A0\n")},
                      {"analog-1-1-1", floats(10)}});
    };
    for (const std::string rate :
         {"-1 MHz", "-1000", "-0", "-0.5 kHz", "1 MHz and more", "fast", "nan", "inf", "1 s"}) {
        put(rate);
        expectRefused("rate.sr", "its sampling rate is '" + rate + "'; a frequency above 0 was expected");
    }
    put("0");
    expectRefused("rate.sr", "states no sampling rate");
    for (const auto& [rate, hertz] : {std::pair("1 MHz", 1e6), {"44100", 44100.0}, {"20 kHz", 20e3}, {"1 GHz", 1e9}}) {
        put(rate);
        const auto reading = accepted(read("rate.sr"));
        EXPECT_DOUBLE_EQ(reading.capture.rate_hz, hertz);
    }
    put("-1 MHz");
    const auto given = accepted(read("rate.sr", {.rate = Hertz(2000)}));
    EXPECT_DOUBLE_EQ(given.capture.rate_hz, 2000);
}

TEST_F(SrFile, CutShortAnywhereIsRefusedAndNeverCrashes) {
    ASSERT_TRUE(format_.write(at("whole.sr"), twoChannels(500, 1e6)).has_value());
    std::ifstream file(at("whole.sr"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 97) {
        std::ofstream(at("cut.sr"), std::ios::binary) << bytes.substr(0, length);
        EXPECT_THAT(read("cut.sr"), refused(ErrorCode::ParseError)) << length;
    }
}

TEST_F(SrFile, OneBitTurnedOverIsRefusedOrChangesNoSample) {
    const auto capture = twoChannels(200, 1e6);
    ASSERT_TRUE(format_.write(at("whole.sr"), capture).has_value());
    std::ifstream file(at("whole.sr"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        auto turned = bytes;
        turned[i] = static_cast<char>(turned[i] ^ (1 << i % 8));
        std::ofstream(at("bit.sr"), std::ios::binary) << turned;
        const auto reading = read("bit.sr");
        if (!reading) continue;
        for (const auto& channel : reading->capture.channels) {
            const bool known =
                channel.samples == capture.channels[0].samples || channel.samples == capture.channels[1].samples;
            EXPECT_TRUE(known) << "byte " << i;
        }
    }
}

TEST_F(SrFile, ChannelsOfUnequalLengthAreTakenToTheShorterWithAWord) {
    std::ofstream(at("short.sr"), std::ios::binary)
        << zipOf({{"version", "2"},
                  {"metadata", metadata("samplerate=1 MHz\ntotal analog=2\nanalog1=A0\nanalog2=A1\n")},
                  {"analog-1-1-1", floats(100)},
                  {"analog-1-1-2", floats(50)},
                  {"analog-1-2-1", floats(120, 2)}});
    const auto reading = accepted(read("short.sr"));
    EXPECT_EQ(reading.capture.samples(), 120U);
    ASSERT_EQ(reading.warnings.size(), 1U);
    EXPECT_THAT(reading.warnings[0], testing::AllOf(HasSubstr("A1"), HasSubstr("120"), HasSubstr("150")));
}

TEST_F(SrFile, WhatItCannotHoldIsRefusedAndTheOldFileStays) {
    ASSERT_TRUE(format_.write(at("kept.sr"), twoChannels(100, 1e6)).has_value());
    const auto size = fs::file_size(at("kept.sr"));
    EXPECT_EQ(format_.write(at("kept.sr"), twoChannels(0, 1e6)).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(format_.write(at("kept.sr"), twoChannels(10, 0.5)).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(fs::file_size(at("kept.sr")), size);
    EXPECT_EQ(format_.write(at("no/such/folder.sr"), twoChannels(10, 1e6)).error().code, ErrorCode::Io);
}

}  // namespace
}  // namespace tacto::test
