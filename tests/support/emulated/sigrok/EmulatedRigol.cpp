#include "tests/support/emulated/sigrok/EmulatedRigol.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/base/LocaleFreeText.h"

namespace tacto::sigrok_driver {

EmulatedRigol::EmulatedRigol(std::shared_ptr<ScopeInput> input, const Clock& clock, std::uint64_t seed,
                             std::string model)
    : input_(std::move(input)), clock_(clock), model_(std::move(model)), noise_(seed, "oscilloscope noise") {}

void EmulatedRigol::advance() {
    const double now_s = toSeconds(clock_.now());
    if (state_ == State::Stopped) return;
    for (;;) {
        if (!trigger_s_ || (complete_ && state_ == State::Running)) {
            const auto found = input_->passes(source_, level_V_, rising_, std::max(searchFrom_s_, 0.0), now_s);
            if (!found) return;
            trigger_s_ = *found;
            complete_ = false;
        }
        const double end_s = *trigger_s_ - before_s() + screen_s();
        if (end_s > now_s) return;
        complete_ = true;
        searchFrom_s_ = end_s + before_s();
        if (state_ == State::Waiting) {
            state_ = State::Stopped;
            return;
        }
    }
}

bool EmulatedRigol::waiting() {
    advance();
    return state_ == State::Waiting;
}

std::size_t EmulatedRigol::length() const { return memory_ ? depth_ : kScreen; }

std::string EmulatedRigol::take(std::string_view command) {
    while (!command.empty() && (command.back() == '\r' || command.back() == ' ')) command.remove_suffix(1);
    if (command.ends_with('?')) return ask(command.substr(0, command.size() - 1));
    const std::size_t space = command.find(' ');
    set(command.substr(0, space), space == std::string_view::npos ? "" : command.substr(space + 1));
    return "";
}

std::string EmulatedRigol::ask(std::string_view what) {
    const auto answer = [](const auto& value) { return fmt::format("{}\n", value); };
    const auto number = [](double value) { return fmt::format("{:.6e}\n", value); };
    if (what == "*IDN") return fmt::format("Rigol Technologies,{},DS2D0000000032,00.03.05\n", model_);
    if (what == "*OPC") return "1\n";
    if (what == "*ESR") return memory_ && !trigger_s_ ? "16\n" : "0\n";
    if (what.starts_with(":CHAN") && what.size() > 7 && (what[5] == '1' || what[5] == '2')) {
        return askChannel(channels_[static_cast<std::size_t>(what[5] - '1')], what.substr(7));
    }
    if (what == ":TIM:SCAL") return number(timebase_s_);
    if (what == ":TIM:OFFS") return number(offset_s_);
    if (what == ":TRIG:EDGE:SOUR") return answer(source_ == 0 ? "CHAN1" : "CHAN2");
    if (what == ":TRIG:EDGE:SLOP") return answer(rising_ ? "POS" : "NEG");
    if (what == ":TRIG:EDGE:LEV") return number(level_V_);
    if (what == ":TRIG:STAT") {
        advance();
        if (state_ == State::Stopped) return "STOP\n";
        return answer(trigger_s_ && !complete_ ? "TD" : "WAIT");
    }
    const double step_V = channels_[static_cast<std::size_t>(read_)].scale_V / kStepsPerDivision;
    if (what == ":WAV:YINC") return number(step_V);
    if (what == ":WAV:YOR") return "0\n";
    if (what == ":WAV:YREF") return answer(kZeroCode);
    if (what == ":WAV:STAT") return fmt::format("IDLE,{}\n", length());
    if (what == ":WAV:DATA") return block();
    return "";  // like the instrument: no answer to an unknown command
}

std::string EmulatedRigol::askChannel(const Channel& channel, std::string_view what) const {
    if (what == "DISP") return channel.on ? "1\n" : "0\n";
    if (what == "PROB") return fmt::format("{:.6e}\n", channel.probe);
    if (what == "SCAL") return fmt::format("{:.6e}\n", channel.scale_V);
    if (what == "OFFS") return "0.000000e+00\n";
    if (what == "COUP") return channel.coupling + "\n";
    return "";
}

void EmulatedRigol::setChannel(Channel& channel, std::string_view what, std::string_view value) {
    const auto number = parseNumber(value);
    if (what == "DISP") channel.on = value == "ON" || value == "1";
    if (what == "PROB" && number) {
        channel.scale_V *= *number / channel.probe;  // keeps the range at the input
        channel.probe = *number;
    }
    if (what == "SCAL" && number && *number > 0) channel.scale_V = *number;
    if (what == "COUP") channel.coupling = value;
}

void EmulatedRigol::set(std::string_view what, std::string_view value) {
    advance();
    const auto number = parseNumber(value);
    if (what.starts_with(":CHAN") && what.size() > 7 && (what[5] == '1' || what[5] == '2')) {
        setChannel(channels_[static_cast<std::size_t>(what[5] - '1')], what.substr(7), value);
    } else if (what == ":TIM:SCAL" && number && *number > 0) {
        timebase_s_ = *number;
    } else if (what == ":TIM:OFFS" && number) {
        offset_s_ = *number;
    } else if (what == ":TRIG:EDGE:SOUR") {
        source_ = value == "CHAN2" ? 1 : 0;
    } else if (what == ":TRIG:EDGE:SLOP") {
        rising_ = value == "POS";
    } else if (what == ":TRIG:EDGE:LEV" && number) {
        level_V_ = *number;
    } else if (what == ":RUN" || what == ":SING") {
        state_ = what == ":RUN" ? State::Running : State::Waiting;
        if (what == ":SING") trigger_s_.reset();
        complete_ = false;
        // No trigger is accepted before the part of the record that precedes the trigger is filled.
        searchFrom_s_ = toSeconds(clock_.now()) + before_s();
    } else if (what == ":STOP") {
        state_ = State::Stopped;
    } else if (what == ":ACQ:MDEP" && number && *number >= 1 && *number <= static_cast<double>(kMemory)) {
        depth_ = static_cast<std::size_t>(*number);
    } else if (what == ":WAV:MODE") {
        memory_ = value == "RAW";
    } else if (what == ":WAV:SOUR") {
        read_ = value == "CHAN2" ? 1 : 0;
    }
}

std::string EmulatedRigol::block() {
    const std::size_t count = length();
    if (read_ == 1 || !channels_[1].on) ++readOut_;
    const auto& channel = channels_[static_cast<std::size_t>(read_)];
    std::vector<double> volts(count);
    if (trigger_s_) {
        input_->sample(read_, *trigger_s_ - before_s(), screen_s() / static_cast<double>(count), volts);
    }
    std::string text = fmt::format("#9{:09}", count);
    const double step_V = channel.scale_V / kStepsPerDivision;
    for (const double one : volts) {
        const double code = std::clamp(std::round(one / step_V + 0.4 * noise_.normal()) + kZeroCode, 0.0, 255.0);
        text.push_back(static_cast<char>(static_cast<unsigned char>(code)));
    }
    return text + "\n";
}

}  // namespace tacto::sigrok_driver
