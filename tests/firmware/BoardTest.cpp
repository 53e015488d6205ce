// The board's encoder on the machines that it is for: the same bits as here, and what it costs. QEMU counts
// instructions, not cycles.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iostream>
#include <map>
#include <sstream>
#include <sys/wait.h>

#include "app/run/EncoderComparison.h"
#include "core/acquisition/Recording.h"
#include "core/dsp/SampleHistory.h"
#include "drivers/sensor_board/EncoderProfile.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;

/// A fingertip's samples from the first on, without a word of when it rests.
struct Samples {
    std::vector<StreamInfo> streams;
    std::vector<SampleBlock> blocks;
};

constexpr std::size_t kBoardTaxels = 8;
constexpr double kTapeStep_s = 0.005;
constexpr const char* kStages[] = {"acceleration",        "force", "taxels", "frames, transforms included",
                                   "of these transforms", "trains"};
constexpr std::size_t kStageCount = std::size(kStages), kTransforms = 4;

/// A tape of Replay.h: the profile as a board with eight taxels has it, then samples in steps of 5 ms.
class Tape {
public:
    explicit Tape(const te_profile& profile) {
        add(&profile, offsetof(te_profile, taxel_scale));
        add(profile.taxel_scale, kBoardTaxels * sizeof(float));
        add(profile.taxel_offset, kBoardTaxels * sizeof(float));
    }
    void event(std::uint32_t kind, std::uint32_t count, double t_s, double step_s, std::size_t columns) {
        const std::int64_t at = std::llround(t_s * 1e9);
        const auto step = static_cast<std::int32_t>(std::llround(step_s * 1e9));
        const auto wide = static_cast<std::uint32_t>(columns);
        add(&kind, 4);
        add(&count, 4);
        add(&at, 8);
        add(&step, 4);
        add(&wide, 4);
    }
    void value(double x) {
        const auto single = static_cast<float>(x);
        add(&single, 4);
    }
    std::string bytes;

private:
    void add(const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); }
};

/// The first taxels of an array, as many as a board has.
Samples narrowed(Samples samples) {
    for (std::size_t s = 0; s < samples.streams.size(); ++s) {
        auto& info = samples.streams[s];
        if (info.kind != StreamKind::Taxels || info.channels <= kBoardTaxels) continue;
        std::vector<double> kept;
        for (std::size_t i = 0; i < samples.blocks[s].samples(); ++i) {
            for (std::size_t c = 0; c < kBoardTaxels; ++c)
                kept.push_back(samples.blocks[s].values[i * info.channels + c]);
        }
        samples.blocks[s].values = std::move(kept);
        info.channels = kBoardTaxels;
    }
    return samples;
}

Samples recorded(const fs::path& path) {
    const auto recording = Recording::open(path);
    EXPECT_TRUE(recording) << recording.error().message;
    return narrowed({recording->infos(), recording->blocks()});
}

TimeInterval extentOf(const Samples& samples) {
    TimeInterval extent{kInfinity_s, -kInfinity_s};
    for (const auto& block : samples.blocks) {
        extent.begin_s = std::min(extent.begin_s, block.t_s.front());
        extent.end_s = std::max(extent.end_s, block.t_s.back());
    }
    return extent;
}

std::string tapeOf(const Samples& samples) {
    constexpr std::uint32_t kKinds[] = {TE_ACCELERATION, TE_FORCE, TE_TAXEL_ARRAY};
    const auto profile = encoderProfile(samples.streams, {}, {}, idealOutput());
    EXPECT_TRUE(profile) << profile.error().message;
    Tape tape(*profile);
    std::vector<std::size_t> taken(samples.streams.size());
    const auto extent = extentOf(samples);
    for (double now = extent.begin_s; now < extent.end_s + kTapeStep_s; now += kTapeStep_s) {
        for (std::size_t s = 0; s < taken.size(); ++s) {
            const auto& block = samples.blocks[s];
            const auto& info = samples.streams[s];
            std::size_t end = taken[s];
            while (end < block.samples() && !(block.t_s[end] > now)) ++end;
            if (end == taken[s]) continue;
            tape.event(kKinds[static_cast<std::size_t>(info.kind)], static_cast<std::uint32_t>(end - taken[s]),
                       block.t_s[taken[s]], 1 / info.rate_hz, info.channels);
            for (std::size_t i = taken[s] * info.channels; i < end * info.channels; ++i) tape.value(block.values[i]);
            taken[s] = end;
        }
        tape.event(3, 0, now, 0, 0);
    }
    return tape.bytes;
}

std::string contentOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

struct Made {
    std::string bytes;
    std::array<std::uint64_t, kStageCount + 2> counts{};
};

Made run(const std::string& program, const std::string& tape) {
    const ScratchDir scratch;
    scratch.write("tape", tape);
    const int status = std::system(("cd '" + scratch.path().string() + "' && " + program + " 2>errors").c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0)
        << program << " ended with " << status << ": " << contentOf(scratch.path() / "errors");
    Made made{contentOf(scratch.path() / "made"), {}};
    const auto counts = contentOf(scratch.path() / "counts");
    if (counts.size() == sizeof made.counts) std::memcpy(made.counts.data(), counts.data(), counts.size());
    return made;
}

struct Machine {
    const char* name;
    const char* board;
    const char* elf;
    [[nodiscard]] std::string command() const {
        return fmt::format(
            "timeout 300 qemu-system-arm -M {} -kernel '{}' -nographic -monitor none -serial none "
            "-semihosting-config enable=on,target=native -icount shift=6,sleep=off",
            board, elf);
    }
};

std::string outputOf(const std::string& command) {
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return {};
    std::string said(400, ' ');
    said.resize(fread(said.data(), 1, said.size(), pipe));
    EXPECT_EQ(pclose(pipe), 0) << command;
    return said;
}

/// Code, constants and values to begin with of the encoder alone, with what it takes of the libraries.
std::uint64_t flashOf(const Machine& machine) {
    const auto said = outputOf(fmt::format("arm-none-eabi-size '{}.alone'", machine.elf));
    std::istringstream in(said.substr(said.find('\n') + 1));
    std::uint64_t text = 0, data = 0, bss = 1;
    in >> text >> data >> bss;
    EXPECT_EQ(bss, 0U) << "the encoder has no memory but its state";
    return text + data;
}

std::vector<Machine> machines() {
    if (std::string_view(TACTO_BOARD_M4).empty()) return {};
    return {{"Cortex-M4F", "mps2-an386", TACTO_BOARD_M4}, {"Cortex-M7", "mps2-an500", TACTO_BOARD_M7}};
}

struct Cost {
    std::array<double, kStageCount> stages{};  ///< instructions per second of signal
    double instructions = 0;                   ///< of all stages
    std::uint64_t stack = 0, state = 0, flash = 0;
};

Cost costOf(const Machine& machine, const Samples& samples) {
    const auto counts = run(machine.command(), tapeOf(samples)).counts;
    const auto extent = extentOf(samples);
    Cost cost;
    for (std::size_t s = 0; s < kStageCount; ++s) {
        cost.stages[s] = static_cast<double>(counts[s]) / (extent.end_s - extent.begin_s);
        if (s != kTransforms) cost.instructions += cost.stages[s];
    }
    cost.stack = counts[kStageCount];
    cost.state = counts[kStageCount + 1];
    cost.flash = flashOf(machine);
    return cost;
}

/// The table of the README.
std::string tableOf(const std::vector<Cost>& costs) {
    std::string table = "| |";
    for (const auto& machine : machines()) table += fmt::format(" {} |", machine.name);
    table += "\n|---|---|---|\n";
    const auto row = [&](std::string_view what, auto value) {
        table += fmt::format("| {} |", what);
        for (const auto& cost : costs) table += fmt::format(" {} |", value(cost));
        table += '\n';
    };
    const auto millions = [](double instructions) { return fmt::format("{:.3f} million", instructions / 1e6); };
    row("flash, bytes", [](const Cost& cost) { return cost.flash; });
    row("RAM: `struct te_state`, bytes", [](const Cost& cost) { return cost.state; });
    row("RAM: stack, bytes, at most", [](const Cost& cost) { return cost.stack; });
    for (std::size_t s = 0; s < kStageCount; ++s) {
        row(fmt::format("{}: instructions per second of signal", kStages[s]),
            [&](const Cost& cost) { return millions(cost.stages[s]); });
    }
    row("all: instructions per second of signal", [&](const Cost& cost) { return millions(cost.instructions); });
    return table;
}

constexpr const char* kNoBoard =
    "gcc-arm-none-eabi, libnewlib-arm-none-eabi and qemu-system-arm are not all here: the encoder was not run as a "
    "microcontroller runs it";

}  // namespace

TEST(EncoderOnCortexM, MakesTheSameBitsAsHere) {
    if (machines().empty()) GTEST_SKIP() << kNoBoard;
    std::map<std::string, Samples> all{
        {"four-touches", recorded(sourceDir() / "resources" / "examples" / "four-touches")},
        {"linen-slide", recorded(sourceDir() / "resources" / "examples" / "linen-slide")}};
    if (const auto real = sharedData("biotac/mat6_1")) all["biotac"] = recorded(*real);
    for (const auto& [name, samples] : all) {
        const auto tape = tapeOf(samples);
        const auto here = run(TACTO_BOARD_HERE, tape);
        EXPECT_GT(here.bytes.size(), 10'000U) << name;
        for (const auto& machine : machines())
            EXPECT_TRUE(run(machine.command(), tape).bytes == here.bytes) << name << " on a " << machine.name;
    }
}

TEST(EncoderOnCortexM, FitsAndSaysWhatItCosts) {
    if (machines().empty()) GTEST_SKIP() << kNoBoard;
    const auto samples = recorded(sourceDir() / "resources" / "examples" / "four-touches");
    std::vector<Cost> costs;
    for (const auto& machine : machines()) {
        const auto& cost = costs.emplace_back(costOf(machine, samples));
        EXPECT_LE(cost.instructions, 10e6) << machine.name;
        EXPECT_GT(cost.instructions, 1e6) << machine.name;
        EXPECT_LE(cost.state + cost.stack, 24'000U) << machine.name;
        EXPECT_LE(cost.flash, 48'000U) << machine.name;
        EXPECT_GT(cost.flash, 5'000U) << machine.name;
    }
    const auto table = tableOf(costs);
    std::cout << table;
    if (const auto version = outputOf("arm-none-eabi-gcc -dumpversion"); version != "12.2.1\n")
        GTEST_SKIP() << "the README's costs are of GCC 12.2.1 and were not compared with those of " << version;
    const auto path = sourceDir() / "resources" / "firmware" / "tactile_encoder" / "README.md";
    auto page = contentOf(path);
    if (std::getenv("TACTO_WRITE_COSTS") != nullptr) {
        const auto begin = page.find("| | Cortex"), end = page.find("\n\n", begin);
        page.replace(begin, end + 1 - begin, table);
        std::ofstream(path, std::ios::binary) << page;
    }
    EXPECT_NE(page.find(table), std::string::npos)
        << "the README states other costs than those measured: run this with TACTO_WRITE_COSTS=1";
}

}  // namespace tacto::test
