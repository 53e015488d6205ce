#include "drivers/sciencemode/ScienceModeDriver.h"

#include <algorithm>
#include <optional>

#include "core/base/LocaleFreeText.h"
#include "core/devices/DeviceUri.h"
#include "drivers/sciencemode/ScienceModeStimulator.h"
#include "drivers/sciencemode/TtyTransport.h"

namespace tacto {
namespace sciencemode {
namespace {

struct Wanted {
    StimulatorSettings settings;
    std::optional<std::string> terminal;
};

std::optional<HighVoltage> highVoltageOf(std::string_view text) {
    const auto volts = parseQuantity(text, "V");
    if (!volts) return std::nullopt;
    for (const auto& [level, name] : {std::pair{30.0, HighVoltage::V30},
                                      {60.0, HighVoltage::V60},
                                      {90.0, HighVoltage::V90},
                                      {120.0, HighVoltage::V120},
                                      {150.0, HighVoltage::V150}}) {
        if (*volts == level) return name;
    }
    return std::nullopt;
}

Result<Wanted> readUri(const DeviceUri& uri) {
    UriParameters from(uri);
    Wanted wanted;
    auto& settings = wanted.settings;
    settings.channel = from.integer("channel", 0, 0, 3);
    settings.connector = from.choice("connector", "yellow", {"yellow", "green"}) == "green" ? 1 : 0;
    const bool current = from.choice("measure", "voltage", {"voltage", "current"}) == "current";
    settings.measurement = current ? Measurement::Current : Measurement::Voltage;
    if (const auto text = from.text("voltage")) {
        const auto level = highVoltageOf(*text);
        if (!level) from.refuse("voltage", *text, "30, 60, 90, 120 or 150 V");
        settings.highVoltage = level.value_or(HighVoltage::Default);
    }
    settings.emulated = from.choice("emulated", "no", {"yes", "no"}) == "yes";
    wanted.terminal = from.text("tty");
    if (wanted.terminal == "") from.refuse("tty", "", "a terminal's path, as /dev/ttyACM0");
    if (const auto read = from.finish(); !read) return failure(read);
    return wanted;
}

/// Asks for the device's identity, then for its state.
Result<Sighting> ask(Result<std::unique_ptr<Transport>> opened, std::string place, std::string_view wanted,
                     const Clock& clock, bool emulated = false) {
    if (!opened) return failure(opened);
    Exchange exchange(**opened, clock);
    auto found = identify(exchange, emulated);
    if (!found) return failure(found);
    if (!wanted.empty() && found->id != wanted) {
        return fail(ErrorCode::NotFound, "stimulator {} answered instead of {}", found->id, wanted);
    }
    const auto answer = exchange.ask(Command::StimStatus);
    if (!answer) return failure(answer);
    const auto status = readStimStatusAck(*answer);
    if (!status) return failure(status);
    return Sighting{std::move(*found), std::move(place), *status, emulated};
}

/// Returns the ports among `all` on which a stimulator answers.
std::vector<TransportPort> thatAnswer(const std::vector<TransportPort>& all, TransportPorts& ports,
                                      const Clock& clock) {
    auto answering = all;
    std::erase_if(answering,
                  [&](const TransportPort& port) { return !ask(openPort(ports, port), port.place, {}, clock); });
    return answering;
}

/// Returns the result of `attempt(port, identity)` from the port where it succeeds. `identity` is the identity that the
/// device must have, or empty for any. Errors: InvalidArgument if several stimulators match (H4); NotFound if there is
/// no port; else the first attempt's error in a sentence of its own.
template <class Attempt>
auto theOneThatAnswers(const DeviceUri& uri, TransportPorts* ports, const Clock& clock, Attempt attempt)
    -> decltype(attempt(TransportPort{}, std::string_view{})) {
    auto all = ports != nullptr ? ports->list() : std::vector<TransportPort>{};
    const auto byAddress = portsNamed(uri.path, all);
    const bool unnamed = uri.path.empty() && all.size() > 1;
    const auto meant = unnamed ? thatAnswer(all, *ports, clock) : byAddress;
    if (meant.size() > 1) {
        return uri.refuseChoice(addressesOf("sciencemode", meant, all));
    }
    if (unnamed && meant.size() == 1) all = meant;
    const auto named = [&](const TransportPort& port) {
        return !byAddress.empty() && port.place == byAddress.front().place;
    };
    // Tries the port with that USB serial number or socket before those whose device may have that identity.
    std::ranges::stable_partition(all, named);
    std::optional<Error> problem;
    for (const auto& port : all) {
        Error reason{ErrorCode::Io, port.obstacle};
        if (port.obstacle.empty()) {
            auto made = attempt(port, named(port) ? std::string_view{} : std::string_view(uri.path));
            if (made) return made;
            reason = made.error();
        }
        // Reports the first reason, unless the port with that address gives one, which takes precedence.
        if (!problem || named(port)) problem = std::move(reason);
        if (named(port)) break;
    }
    const auto what =
        uri.path.empty() ? std::string("no stimulator answers") : fmt::format("no stimulator \"{}\" answers", uri.path);
    if (problem) return uri.refuse(problem->code, "{}: {}", what, problem->message);
    return uri.refuse(ErrorCode::NotFound, "{}: none is plugged in (USB 0483:5740)", what);
}

class ScienceModeDriver final : public Driver {
public:
    explicit ScienceModeDriver(std::shared_ptr<TransportPorts> ports) : ports_(std::move(ports)) {}

    std::string_view scheme() const noexcept override { return "sciencemode"; }
    bool runsOnVirtualClock() const noexcept override { return false; }

    std::vector<DeviceIdentity> list() const override {
        if (!ports_) return {};
        return identitiesAt(*ports_, "sciencemode", Role::Stimulator,
                            "ScienceMode stimulator, or another STM32 serial port");
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        if (auto free = into.checkFree(Role::Stimulator, uri); !free) return free;
        const auto wanted = readUri(uri);
        if (!wanted) return failure(wanted);
        auto opened = wanted->terminal ? openTerminal(uri, *wanted, context) : openPort(uri, *wanted, context);
        if (!opened) return failure(opened);
        into.stimulator = std::move(*opened);
        return {};
    }

private:
    using Opened = Result<std::unique_ptr<ScienceModeStimulator>>;

    static Opened openTerminal(const DeviceUri& uri, const Wanted& wanted, const OpenContext& context) {
        const auto connect = [path = *wanted.terminal] { return TtyTransport::open(path); };
        return ScienceModeStimulator::open(connect, uri.text(), uri.path, wanted.settings, context.clock);
    }

    Opened openPort(const DeviceUri& uri, const Wanted& wanted, const OpenContext& context) const {
        return theOneThatAnswers(uri, ports_.get(), context.clock,
                                 [&](const TransportPort& port, std::string_view identity) {
                                     auto connect = connectTo(ports_, addressOf(port, ports_->list()), "stimulator");
                                     return ScienceModeStimulator::open(std::move(connect), uri.text(), identity,
                                                                        wanted.settings, context.clock);
                                 });
    }

    const std::shared_ptr<TransportPorts> ports_;
};

}  // namespace

Result<Sighting> lookAt(const DeviceUri& uri, TransportPorts* ports, const Clock& clock) {
    if (uri.scheme != "sciencemode") {
        return uri.refuse(ErrorCode::InvalidArgument, "this is not a ScienceMode stimulator; sciencemode: is expected");
    }
    const auto wanted = readUri(uri);
    if (!wanted) return failure(wanted);
    const bool emulated = wanted->settings.emulated;
    if (wanted->terminal)
        return ask(TtyTransport::open(*wanted->terminal), *wanted->terminal, uri.path, clock, emulated);
    return theOneThatAnswers(uri, ports, clock, [&](const TransportPort& port, std::string_view identity) {
        return ask(ports->open(port), port.place, identity, clock, emulated);
    });
}

}  // namespace sciencemode

std::unique_ptr<Driver> makeScienceModeDriver(std::shared_ptr<TransportPorts> ports) {
    return std::make_unique<sciencemode::ScienceModeDriver>(std::move(ports));
}

}  // namespace tacto
