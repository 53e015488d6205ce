#include <array>
#include <atomic>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <thread>

#include "core/base/SpscRing.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

TEST(SpscRing, GivesElementsBackInOrder) {
    SpscRing<int> ring(4);
    EXPECT_FALSE(ring.pop());
    ring.push(1);
    ring.push(2);
    EXPECT_EQ(ring.pop(), 1);
    ring.push(3);
    EXPECT_EQ(ring.pop(), 2);
    EXPECT_EQ(ring.pop(), 3);
    EXPECT_FALSE(ring.pop());
    EXPECT_EQ(ring.dropped(), 0U);
}

TEST(SpscRing, DropsTheOldestWhenFullAndCountsIt) {
    SpscRing<int> ring(3);
    for (int i = 0; i < 10; ++i) ring.push(i);
    EXPECT_EQ(ring.dropped(), 7U);
    EXPECT_EQ(ring.pop(), 7);
    EXPECT_EQ(ring.pop(), 8);
    EXPECT_EQ(ring.pop(), 9);
    EXPECT_FALSE(ring.pop());
}

TEST(SpscRing, HasRoomForAtLeastOne) {
    SpscRing<int> ring(0);
    EXPECT_EQ(ring.capacity(), 1U);
    ring.push(5);
    EXPECT_EQ(ring.pop(), 5);
}

/// Odd-sized, with several words that all follow from the first: a torn copy is always recognised.
struct Element {
    std::uint64_t number;
    std::uint64_t words[5];
    std::uint8_t last;

    static Element of(std::uint64_t n) {
        Element e{};
        e.number = n;
        for (std::uint64_t w = 0; w < 5; ++w) e.words[w] = n * 0x9E3779B97F4A7C15ULL + w;
        e.last = static_cast<std::uint8_t>(n);
        return e;
    }
    [[nodiscard]] bool whole() const {
        const Element expected = of(number);
        bool same = last == expected.last;
        for (std::size_t w = 0; w < 5; ++w) same = same && words[w] == expected.words[w];
        return same;
    }
};

class SpscRingThreads : public testing::TestWithParam<std::size_t> {};

TEST_P(SpscRingThreads, LoseNothingUncountedAndTearNothing) {
#ifdef TACTOSCOPE_SANITIZED
    constexpr std::uint64_t kPushes = 50'000;
#else
    const auto kPushes = test::trials<std::uint64_t>({.local = 100'000, .ci = 500'000, .campaign = 5'000'000});
#endif
    SpscRing<Element> ring(GetParam());
    std::atomic<bool> done{false};
    std::thread producer([&] {
        for (std::uint64_t n = 1; n <= kPushes; ++n) {
            ring.push(Element::of(n));
            if (n % 64 == 0) std::this_thread::yield();  // lets the consumer run in between, even on one core
        }
        done.store(true, std::memory_order_release);
    });
    std::uint64_t popped = 0;
    std::uint64_t torn = 0;
    std::uint64_t disordered = 0;
    std::uint64_t last = 0;
    for (;;) {
        const bool finished = done.load(std::memory_order_acquire);
        std::array<Element, 20> elements;
        const auto count = ring.pop(std::span(elements).first(1 + popped % elements.size()));
        for (const auto& element : std::span(elements).first(count)) {
            torn += element.whole() ? 0 : 1;
            disordered += element.number > last ? 0 : 1;
            last = element.number;
        }
        popped += count;
        if (count == 0 && finished) break;
    }
    producer.join();
    EXPECT_EQ(torn, 0U);
    EXPECT_EQ(disordered, 0U);
    EXPECT_EQ(popped + ring.dropped(), kPushes);
    EXPECT_EQ(last, kPushes) << "the newest element is never the one dropped";
    EXPECT_GT(popped, 0U);
}

INSTANTIATE_TEST_SUITE_P(Capacities, SpscRingThreads, testing::Values(1, 2, 7, 64, 1024),
                         testing::PrintToStringParamName());

/// Larger than the block that is compared at once, and not a whole number of words.
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
    value.parts.back() += 1;  // the last, incomplete word
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
            if (n % 64 == 0) std::this_thread::yield();  // lets the reader run in between, even on one core
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
