#include "tests/drivers/sigrok/ScopeOnLan.h"

#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>

#include "drivers/sigrok/driver/SigrokDriver.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {

using sigrok_driver::CircuitInput;
using sigrok_driver::EmulatedRigol;
using sigrok_driver::EmulatedScopeServer;

ScopeOnLan::ScopeOnLan(const std::string& parameters, const std::string& stimulator, const std::string& model)
    : parameters_(parameters), driver_(makeSigrokDriver({})) {
    bench_.open(stimulator);
    auto input = std::make_shared<CircuitInput>(bench_.circuit(), bench_.clock, Ohms(kShuntOhm));
    server_ =
        accepted(EmulatedScopeServer::start(std::make_unique<EmulatedRigol>(std::move(input), bench_.clock, 1, model)));
    if (const auto opened = open(); !opened) throw std::runtime_error(opened.error().message);
}

std::string ScopeOnLan::uri() const {
    return fmt::format("sigrok:rigol-ds:conn=tcp-raw/127.0.0.1/{}?voltage=CH1&current=CH2&shunt={}ohm{}",
                       server_->port(), kShuntOhm, parameters_);
}

Result<void> ScopeOnLan::open() {
    const OpenContext context{bench_.clock, 1};
    return driver_->open(DeviceUri::parse(uri()).value(), {}, context, opened_);
}

void ScopeOnLan::arm(const ScopeSettings& settings) {
    const auto configured = scope().configure(settings);
    ASSERT_IN_TIME(configured);
    const auto armed = scope().arm();
    ASSERT_IN_TIME(armed);
    // Waits enough signal time to fill the part of a record before the trigger.
    bench_.wait(Seconds(0.05));
}

void ScopeOnLan::pass(Seconds duration) {
    const auto before = server_->readOut();
    const bool waited = server_->waits(Seconds(0));
    bench_.wait(duration);
    if (waited && !server_->waits(Seconds(0))) (void)server_->hasReadOut(before + 1, Seconds(5));
}

Result<std::optional<Capture>> ScopeOnLan::poll(Seconds timeout) {
    const auto until = std::chrono::steady_clock::now() + timeout;
    for (;;) {
        auto found = scope().poll();
        if (!found || *found || std::chrono::steady_clock::now() > until) return found;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

}  // namespace tacto::test
