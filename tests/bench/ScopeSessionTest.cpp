// An oscilloscope's session with a device that misbehaves.
#include <gtest/gtest.h>
#include <new>

#include "core/bench/sensing/ScopeSession.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

/// An oscilloscope with a record larger than the free memory.
struct LargeScope final : Oscilloscope {
    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return who; }
    [[nodiscard]] const ScopeTraits& traits() const noexcept override { return what; }
    [[nodiscard]] Result<void> configure(const ScopeSettings&) override { return {}; }
    [[nodiscard]] Result<void> arm() override { return {}; }
    [[nodiscard]] Result<std::optional<Capture>> poll() override { throw std::bad_alloc(); }
    void disarm() noexcept override { ++disarmed; }

    DeviceIdentity who;
    ScopeTraits what;
    int disarmed = 0;
};

TEST(ScopeSession, ARecordThatDoesNotFitIntoMemoryIsAnErrorAndNoEnd) {
    RecordProperty("hazard", "H10");
    LargeScope scope;
    ScopeSession session(scope);
    session.request({}, Instant{0}, 1, {});
    session.serve(Instant{0});
    session.serve(Instant{1});
    EXPECT_TRUE(session.failed());
    EXPECT_FALSE(session.active());
    EXPECT_GT(scope.disarmed, 1);
    EXPECT_THAT(session.take(), refusedSaying(testing::Eq("no memory left")));
}

}  // namespace
}  // namespace tacto::test
