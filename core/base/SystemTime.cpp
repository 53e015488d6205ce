#include "core/base/SystemTime.h"

#include <ctime>
#include <fstream>

namespace tacto {

namespace {

class RealTime final : public SystemTime {
public:
    [[nodiscard]] Instant sinceBoot() const noexcept override {
        std::timespec at{};
        clock_gettime(CLOCK_BOOTTIME, &at);
        return std::chrono::seconds(at.tv_sec) + std::chrono::nanoseconds(at.tv_nsec);
    }
    [[nodiscard]] std::string boot() const override {
        std::ifstream in("/proc/sys/kernel/random/boot_id");
        std::string id;
        std::getline(in, id);
        return id;
    }
    [[nodiscard]] std::chrono::sys_seconds wall() const noexcept override {
        return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    }
};

}  // namespace

const SystemTime& SystemTime::real() noexcept {
    static const RealTime time;
    return time;
}

}  // namespace tacto
