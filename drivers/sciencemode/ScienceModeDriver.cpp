#include "drivers/sciencemode/ScienceModeDriver.h"

#include <algorithm>
#include <optional>

#include "core/base/Text.h"
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

/// Takes one parameter. Nothing when it is well; else what is accepted.
std::optional<std::string> take(std::string_view key, std::string_view value, Wanted& into) {
    auto& settings = into.settings;
    if (key == "channel") {
        const auto number = parseNumber(value);
        if (!number || !(*number == 0 || *number == 1 || *number == 2 || *number == 3)) return "0, 1, 2 or 3";
        settings.channel = static_cast<int>(*number);
    } else if (key == "connector") {
        if (value != "yellow" && value != "green") return "yellow or green";
        settings.connector = value == "green" ? 1 : 0;
    } else if (key == "measure") {
        if (value != "voltage" && value != "current") return "voltage or current";
        settings.measurement = value == "voltage" ? Measurement::Voltage : Measurement::Current;
    } else if (key == "voltage") {
        const auto level = highVoltageOf(value);
        if (!level) return "30, 60, 90, 120 or 150 V";
        settings.highVoltage = *level;
    } else if (key == "tty") {
        if (value.empty()) return "a terminal's path, as /dev/ttyACM0";
        into.terminal = value;
    } else {
        return "there is no such parameter: it takes channel, connector, measure, voltage, tty";
    }
    return std::nullopt;
}

Result<Wanted> readUri(const DeviceUri& uri) {
    Wanted wanted;
    std::vector<std::string_view> seen;
    for (const auto& [key, value] : uri.parameters) {
        if (std::ranges::find(seen, key) != seen.end()) {
            return fail(ErrorCode::InvalidArgument, "device \"{}\": {} is given twice", uri.text(), key);
        }
        seen.push_back(key);
        if (const auto accepted = take(key, value, wanted)) {
            return fail(ErrorCode::InvalidArgument, "device \"{}\": {}={} is not accepted: {}", uri.text(), key, value,
                        *accepted);
        }
    }
    return wanted;
}

/// Opens the port that was opened before: by serial number wherever it is plugged in now, else in its place.
Connect connectTo(std::shared_ptr<TransportPorts> ports, const TransportPort& port) {
    auto address = addressOf(port, ports->list());
    return [ports = std::move(ports), address = std::move(address)]() -> Result<std::unique_ptr<Transport>> {
        const auto found = portsNamed(address, ports->list());
        if (found.size() != 1) {
            return fail(ErrorCode::NotFound, "the stimulator sciencemode:{} is not plugged in", address);
        }
        if (!found.front().obstacle.empty()) return fail(ErrorCode::Io, "{}", found.front().obstacle);
        return ports->open(found.front());
    };
}

/// Asks who is there, then how it is.
Result<Sighting> ask(Result<std::unique_ptr<Transport>> opened, std::string place, std::string_view wanted,
                     const Clock& clock) {
    if (!opened) return failure(opened);
    Exchange exchange(**opened, clock);
    auto found = identify(exchange);
    if (!found) return failure(found);
    if (!wanted.empty() && found->id != wanted) {
        return fail(ErrorCode::NotFound, "stimulator {} answered where {} was asked for", found->id, wanted);
    }
    const auto answer = exchange.ask(Command::StimStatus);
    if (!answer) return failure(answer);
    const auto status = readStimStatusAck(*answer);
    if (!status) return failure(status);
    if (status->result != ResultCode::Ok) return refusal(Command::StimStatus, status->result);
    return Sighting{std::move(*found), std::move(place), *status};
}

/// The ports among `all` where a stimulator answers.
std::vector<TransportPort> thatAnswer(const std::vector<TransportPort>& all, TransportPorts& ports,
                                      const Clock& clock) {
    auto answering = all;
    std::erase_if(answering, [&](const TransportPort& port) {
        return !port.obstacle.empty() || !ask(ports.open(port), port.place, {}, clock);
    });
    return answering;
}

/// What `attempt(port, identity)` makes of the port where it succeeds. `identity` is the one that the device must have;
/// empty: any. Errors: InvalidArgument where several stimulators are meant (H4); NotFound where there is no port; else
/// the first attempt's, in a sentence of its own.
template <class Attempt>
auto theOneThatAnswers(const DeviceUri& uri, TransportPorts* ports, const Clock& clock, Attempt attempt)
    -> decltype(attempt(TransportPort{}, std::string_view{})) {
    auto all = ports != nullptr ? ports->list() : std::vector<TransportPort>{};
    const auto byAddress = portsNamed(uri.path, all);
    const bool unnamed = uri.path.empty() && all.size() > 1;
    const auto meant = unnamed ? thatAnswer(all, *ports, clock) : byAddress;
    if (meant.size() > 1) {
        return fail(ErrorCode::InvalidArgument, "device \"{}\" could be {}: name one", uri.text(),
                    choiceOf("sciencemode", meant, all));
    }
    if (unnamed && meant.size() == 1) all = meant;
    const auto named = [&](const TransportPort& port) {
        return !byAddress.empty() && port.place == byAddress.front().place;
    };
    // The one with that USB serial number or in that socket before those that may have that identity.
    std::ranges::stable_partition(all, named);
    std::optional<Error> problem;
    for (const auto& port : all) {
        Error reason{ErrorCode::Io, port.obstacle};
        if (port.obstacle.empty()) {
            auto made = attempt(port, named(port) ? std::string_view{} : std::string_view(uri.path));
            if (made) return made;
            reason = made.error();
        }
        // The first reason is told, but what the port with that address says before all others.
        if (!problem || named(port)) problem = std::move(reason);
        if (named(port)) break;
    }
    const auto what =
        uri.path.empty() ? std::string("no stimulator answers") : fmt::format("no stimulator \"{}\" answers", uri.path);
    if (problem) return fail(problem->code, "device \"{}\": {}: {}", uri.text(), what, problem->message);
    return fail(ErrorCode::NotFound, "device \"{}\": {}: none is plugged in (USB 0483:5740)", uri.text(), what);
}

class ScienceModeDriver final : public Driver {
public:
    explicit ScienceModeDriver(std::shared_ptr<TransportPorts> ports) : ports_(std::move(ports)) {}

    std::string_view scheme() const noexcept override { return "sciencemode"; }
    bool runsOnVirtualClock() const noexcept override { return false; }

    std::vector<DeviceIdentity> list() const override {
        std::vector<DeviceIdentity> found;
        if (!ports_) return found;
        const auto all = ports_->list();
        for (const auto& port : all) {
            found.push_back({"sciencemode:" + addressOf(port, all), Role::Stimulator,
                             "ScienceMode stimulator, or another STM32 serial port", port.serial, "", false,
                             port.obstacle});
        }
        return found;
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        if (into.has(Role::Stimulator)) {
            return fail(ErrorCode::InvalidArgument,
                        "device \"{}\": a stimulator is open already, and a bench has one of each", uri.text());
        }
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
                                     return ScienceModeStimulator::open(connectTo(ports_, port), uri.text(), identity,
                                                                        wanted.settings, context.clock);
                                 });
    }

    const std::shared_ptr<TransportPorts> ports_;
};

}  // namespace

Result<Sighting> lookAt(const DeviceUri& uri, TransportPorts* ports, const Clock& clock) {
    if (uri.scheme != "sciencemode") {
        return fail(ErrorCode::InvalidArgument, "device \"{}\" is no ScienceMode stimulator; sciencemode: is expected",
                    uri.text());
    }
    const auto wanted = readUri(uri);
    if (!wanted) return failure(wanted);
    if (wanted->terminal) return ask(TtyTransport::open(*wanted->terminal), *wanted->terminal, uri.path, clock);
    return theOneThatAnswers(uri, ports, clock, [&](const TransportPort& port, std::string_view identity) {
        return ask(ports->open(port), port.place, identity, clock);
    });
}

}  // namespace sciencemode

std::unique_ptr<Driver> makeScienceModeDriver(std::shared_ptr<TransportPorts> ports) {
    return std::make_unique<sciencemode::ScienceModeDriver>(std::move(ports));
}

}  // namespace tacto
