#include "core/bench/LevelRequests.h"

#include <utility>

namespace tacto {

namespace {

Result<void> tell(SafetyGate& gate, const LevelRequest& request) {
    switch (request.what) {
        case LevelRequest::What::Accept:
            return gate.accept(request.train);
        case LevelRequest::What::Discomfort:
            return gate.reportDiscomfort(request.uncomfortable);
        case LevelRequest::What::BeginAscending:
            gate.beginAscending();
            return {};
        case LevelRequest::What::EndAscending:
            gate.endAscending();
            return {};
        case LevelRequest::What::Ceiling:
            return {};
    }
    return {};
}

Result<Milliamps> answerOf(SafetyGate& gate, const LevelRequest& request) {
    if (!gate.levelCeiling(request.train))
        return fail(ErrorCode::NotArmed, "levels of a person are known from the first arming in person mode on");
    if (auto told = tell(gate, request); !told) return failure(told);
    return *gate.levelCeiling(request.train);
}

}  // namespace

void LevelRequests::ask(const LevelRequest& request) {
    const std::scoped_lock lock(mutex_);
    request_ = request;
    answer_.reset();
    asked_.store(true, std::memory_order_release);
}

std::optional<Result<Milliamps>> LevelRequests::answer() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(answer_, std::nullopt);
}

void LevelRequests::serve(SafetyGate& gate) noexcept {
    if (!asked_.load(std::memory_order_acquire)) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    asked_.store(false, std::memory_order_release);
    if (const auto request = std::exchange(request_, std::nullopt)) answer_ = answerOf(gate, *request);
}

}  // namespace tacto
