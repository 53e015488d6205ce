// 10^4 spoilt EDF, BDF and XDF files are read or refused, and take no more memory than files of their size do (hazard
// H10: a file from elsewhere).
#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <malloc.h>
#include <new>

#include "core/base/Random.h"
#include "core/exchange/recordings/OpenRecording.h"
#include "tests/exchange/recordings/Made.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

namespace {
thread_local std::size_t held = 0, most = 0;
}  // namespace

#ifndef TACTOSCOPE_SANITIZED
void* operator new(std::size_t size) {
    void* memory = std::malloc(size == 0 ? 1 : size);
    if (memory == nullptr) throw std::bad_alloc();
    held += malloc_usable_size(memory);
    most = std::max(most, held);
    return memory;
}
void operator delete(void* memory) noexcept {
    held -= std::min(held, malloc_usable_size(memory));
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
#endif

namespace tacto {
namespace {

using namespace test;

std::vector<std::string> soundFiles() {
    std::vector<double> stamps;
    for (int i = 0; i < 200; ++i) stamps.push_back(5 + i * 0.01);
    const auto row = [](std::size_t i, std::size_t c) { return 0.1 * static_cast<double>(i * 3 + c); };
    auto texts = littleEndianBytes(std::uint32_t{9}) + std::string("\x01\x02");
    for (int i = 0; i < 2; ++i) texts += "\x08" + littleEndianBytes(6.0 + i) + "\x01\x04stop";
    std::string bytes = littleEndianBytes(std::uint32_t{8}) + std::string("\x01\xC8");
    for (int i = 0; i < 200; ++i) bytes += std::string(1, '\0') + static_cast<char>(i);
    const auto xdf = kXdfBegin +
                     xdfHeader(7, "Finger", "Acc", "float32", 3, 100, {{"x", "g"}, {"y", "g"}, {"z", "g"}}) +
                     xdfHeader(8, "Bytes", "", "int8", 1, 100) + xdfHeader(9, "Marks", "Markers", "string", 1, 0) +
                     xdfSamples(7, stamps, 3, row) + xdfOffset(7, 5, 0.1) + xdfBoundary() + xdfChunk(3, texts) +
                     xdfSamples(7, stamps, 3, row) + xdfChunk(3, bytes) + xdfOffset(7, 9, 0.2) + xdfOffset(7, 12, 0.3) +
                     xdfChunk(77, "unknown") +
                     xdfChunk(6, littleEndianBytes(std::uint32_t{7}) + "<info><sample_count>400</sample_count></info>");
    EdfMade made;
    made.signals = {{}, {.label = "taxel 1"}, {.label = "slow", .perRecord = "7"}};
    const auto value = [](std::size_t, std::size_t k) { return static_cast<int>(k * 37 % 60000) - 30000; };
    EdfMade wide = made;
    wide.bdf = true;
    wide.reserved = "BDF+C";
    return {xdf, xdf, made.file(value), wide.file(value)};
}

std::string spoilt(std::string file, Random& random) {
    const auto pick = [&](std::size_t below) { return static_cast<std::size_t>(random.below(below)); };
    for (auto changes = 1 + pick(4); changes > 0 && !file.empty(); --changes) {
        // Half of the changes are in the headers.
        const auto at = pick(pick(2) == 0 ? std::min<std::size_t>(file.size(), 1300) : file.size());
        switch (pick(6)) {
            case 0:
                file[at] = static_cast<char>(file[at] ^ (1 << pick(8)));
                break;
            case 1:
                file[at] = static_cast<char>(pick(256));
                break;
            case 2:
                file.resize(at);
                break;
            case 3:
                file.erase(at, 1 + pick(40));
                break;
            case 4:
                for (std::size_t i = at; i < std::min(at + 8, file.size()); ++i)
                    file[i] = std::string_view(
                        "\xFF\x7F"
                        "90-.e ")[pick(8)];
                break;
            default:
                file.insert(at, file.substr(pick(file.size()), pick(600)));
        }
    }
    return file;
}

TEST(SpoiltFiles, AreReadOrRefusedInTheMemoryOfTheirSize) {
    RecordProperty("hazard", "H10");
    const auto sound = soundFiles();
    Random random(50, "spoilt files");
    const ScratchDir folder;
    const int files = trials<int>({.local = 10'000, .ci = 10'000, .campaign = 200'000});
    constexpr const char* kNames[] = {"a.xdf", "b.xdf", "a.edf", "a.bdf"};
    int read = 0, refused = 0;
    for (int i = 0; i < files; ++i) {
        const auto which = static_cast<std::size_t>(i) % sound.size();
        const auto bytes = spoilt(sound[which], random);
        const auto path = folder.write(kNames[which], bytes);
        const auto before = most = held;
        const auto file = readSignals(path);
        constexpr std::size_t kFactor = 20, kBeside = 1 << 16;
        constexpr std::size_t kTableOfEdflib = 1 << 21;  // of its signals, of which it has 640 or (1.27) 4096
        const bool isXdf = std::string_view(kNames[which]).ends_with(".xdf");
        if (most - before > kFactor * bytes.size() + (isXdf ? kBeside : kTableOfEdflib)) {
            ADD_FAILURE() << "file " << i << " of " << bytes.size() << " bytes took " << most - before;
            break;
        }
        ++(file ? read : refused);
        if (!file) {
            EXPECT_FALSE(file.error().message.empty());
            continue;
        }
        for (const auto& stream : (*file)->streams) {
            if (stream.texts) continue;
            ASSERT_EQ(stream.samples.t_s.size(), stream.count);
            ASSERT_EQ(stream.samples.values.size(), stream.count * stream.width);
        }
        if (i % 8 < 4) static_cast<void>(openRecording(path));  // a recording, or a sentence
    }
    EXPECT_GT(read, files / 20);
    EXPECT_GT(refused, files / 20);
}

}  // namespace
}  // namespace tacto
