#include <array>
#include <atomic>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <thread>

#include "core/base/Latest.h"

namespace tacto {
namespace {

/// Larger than what is compared at a time, and no whole number of words.
struct Value {
    std::array<std::uint32_t, 501> parts{};
    bool operator==(const Value&) const = default;
};

TEST(Latest, GivesBackEachValueWhateverChangedSinceTheOneBefore) {
    Latest<Value> latest;
    EXPECT_EQ(latest.read(), Value{});
    std::mt19937 random(1);
    Value value;
    for (int i = 0; i < 2000; ++i) {
        for (auto changes = random() % 4; changes > 0; --changes)
            value.parts[random() % value.parts.size()] = static_cast<std::uint32_t>(random());
        latest.write(value);
        ASSERT_EQ(latest.read(), value) << i;
    }
    value.parts.back() += 1;  // the word that is not whole
    latest.write(value);
    EXPECT_EQ(latest.read(), value);
    latest.write(Value{});
    EXPECT_EQ(latest.read(), Value{});
}

TEST(Latest, AReaderNeverSeesHalfOfOneAndHalfOfTheNext) {
    Latest<Value> latest;
    std::atomic<bool> done{false};
    std::jthread writer([&] {
        Value value;
        for (std::uint32_t n = 1; n <= 20'000; ++n) {
            value.parts.front() = value.parts.back() = n;
            if (n % 3 == 0) value.parts[250] = n;
            latest.write(value);
            if (n % 64 == 0) std::this_thread::yield();  // lets the reader overlap on one core too
        }
        done.store(true, std::memory_order_release);
    });
    std::uint32_t last = 0;
    while (!done.load(std::memory_order_acquire)) {
        const auto value = latest.read();
        const auto n = value.parts.front();
        ASSERT_EQ(value.parts.back(), n);
        ASSERT_EQ(value.parts[250], n - n % 3);
        ASSERT_GE(n, last);
        last = n;
    }
    writer.join();
    EXPECT_EQ(latest.read().parts.front(), 20'000U);
}

}  // namespace
}  // namespace tacto
