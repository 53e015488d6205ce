// EDF, BDF and XDF files at random hold for us what they hold for pyxdf, pyEDFlib and edfio.
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/exchange/recordings/OpenRecording.h"
#include "tests/exchange/recordings/Readers.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json jsonIn(const fs::path& file) {
    std::ifstream in(file);
    return Json::parse(in);
}

constexpr int kSeed = 20261130;

/// Makes random files and hands each with what others read in it to `compare`.
template <class Compare>
void compareWithOthers(const char* which, int files, Compare&& compare) {
    const auto python = test::pythonWithReaders();
    if (!python) GTEST_SKIP() << test::kNoPackages;
    const test::ScratchDir folder;
    const auto script = test::sourceDir() / "tests/exchange/recordings/oracle.py";
    const auto [code, said] = test::outputOfShell(
        fmt::format("'{}' '{}' {} '{}' {} {}", *python, script.string(), which, folder.path().string(), kSeed, files));
    ASSERT_EQ(code, 0) << said;
    int compared = 0;
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        if (entry.path().extension() == ".json") continue;
        SCOPED_TRACE(entry.path().filename().string());
        const auto file = readSignals(entry.path());
        ASSERT_TRUE(file) << file.error().message;
        ASSERT_TRUE(*file);
        compare(**file, jsonIn(entry.path().string() + ".json"));
        ++compared;
    }
    EXPECT_EQ(compared, files);
}

double numberIn(const Json& value) { return value.is_null() ? std::nan("") : value.get<double>(); }

TEST(OthersReaders, PyxdfReadsTheSameStampsAndValues) {
    const int files = test::trials<int>({.local = 40, .ci = 200, .campaign = 2000});
    compareWithOthers("xdf", files, [](const SignalFile& ours, const Json& theirs) {
        EXPECT_TRUE(ours.warnings.empty());
        ASSERT_EQ(ours.streams.size(), theirs.size());
        for (std::size_t s = 0; s < theirs.size(); ++s) {
            const auto& stream = ours.streams[s];
            EXPECT_EQ(stream.id, theirs[s]["id"].get<std::uint32_t>());
            EXPECT_EQ(stream.name, theirs[s]["name"].get<std::string>());
            EXPECT_EQ(stream.obstacle, "");
            ASSERT_EQ(stream.count, theirs[s]["count"].get<std::size_t>());
            if (stream.texts) continue;
            double furthest = 0;
            std::size_t unequal = 0;
            for (std::size_t i = 0; i < stream.count; ++i) {
                furthest = std::max(furthest, std::abs(stream.samples.t_s[i] - theirs[s]["t"][i].get<double>()));
                for (std::size_t c = 0; c < stream.width; ++c) {
                    const double value = stream.samples.values[i * stream.width + c];
                    const double other = numberIn(theirs[s]["values"][i][c]);
                    unequal += value == other || (std::isnan(value) && std::isnan(other)) ? 0 : 1;
                }
            }
            EXPECT_LE(furthest, 1e-4) << "seconds, in stream " << stream.name;
            EXPECT_EQ(unequal, 0U);
        }
    });
}

TEST(OthersReaders, PyEdflibAndEdfioReadTheSameSignals) {
    const int files = test::trials<int>({.local = 40, .ci = 200, .campaign = 2000});
    compareWithOthers("edf", files, [](const SignalFile& ours, const Json& theirs) {
        std::size_t channels = 0;
        for (const auto& stream : ours.streams) {
            for (std::size_t c = 0; c < stream.width; ++c) {
                const auto& channel = stream.channels[c];
                ++channels;
                const auto& other = theirs.at(channel.number - 1);
                EXPECT_EQ(channel.label, other["label"].get<std::string>());
                EXPECT_EQ(channel.unit, other["unit"].get<std::string>());
                EXPECT_NEAR(stream.rate_hz, other["rate"].get<double>(), 1e-9 * stream.rate_hz);
                ASSERT_EQ(stream.count, other["values"].size());
                double furthest = 0, most = 1;
                for (std::size_t i = 0; i < stream.count; ++i) {
                    const double value = other["values"][i].get<double>();
                    most = std::max(most, std::abs(value));
                    furthest = std::max(furthest, std::abs(stream.samples.values[i * stream.width + c] - value));
                    EXPECT_NEAR(stream.samples.t_s[i], static_cast<double>(i) / other["rate"].get<double>(), 1e-9);
                }
                EXPECT_LE(furthest, 1e-9 * most);
            }
        }
        EXPECT_EQ(channels, theirs.size());
    });
}

}  // namespace
}  // namespace tacto
