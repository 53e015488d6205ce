// The board's encoder with any profile and any samples at any time: no fault of memory or arithmetic, R and P between 0
// and 1, and no train above the ceilings (hazard H1).
//
//     changes of the profile, each a word's number and its new value; then events: a kind (bits 0 and 1: a stream, or a
//     step; bit 6: the time is given whole; bit 7: values are given whole), a time, a count, values
#include <cmath>
#include <cstring>
#include <memory>

#include "drivers/sensor_board/EncoderProfile.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::EncoderFuzz {

namespace {

using namespace tacto;

class Input {
public:
    Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    [[nodiscard]] bool over() const { return size_ == 0; }
    template <class Value>
    Value take() {
        Value value{};
        const std::size_t used = std::min(sizeof value, size_);
        std::memcpy(&value, data_, used);
        data_ += used;
        size_ -= used;
        return value;
    }

private:
    const std::uint8_t* data_;
    std::size_t size_;
};

const te_profile& sound() {
    static const te_profile profile = [] {
        const std::vector<StreamInfo> streams{
            {StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 2, 1000, "acceleration"},
            {StreamKind::Force, StreamUnit::Newton, 1, 200, "force"},
            {StreamKind::Taxels, StreamUnit::Pascal, 4, 200, "taxels"}};
        EncoderOutput output;
        output.source.amplitudeMax = 60;
        output.load = LoadRange::declared(Load::resistor(Ohms(1000)));
        return encoderProfile(streams, {}, {}, output).value();
    }();
    return profile;
}

te_profile changed(Input& in) {
    te_profile profile = sound();
    for (int changes = in.take<std::uint8_t>() % 8; changes > 0; --changes) {
        const std::size_t word = 2 + in.take<std::uint8_t>() % (sizeof profile / 4 - 2);
        const auto value = in.take<std::uint32_t>();
        std::memcpy(reinterpret_cast<char*>(&profile) + 4 * word, &value, sizeof value);
    }
    profile.hash = te_hash(&profile);
    return profile;
}

bool isUnitOrAbsent(float x) { return std::isnan(x) || (x >= 0 && x <= 1); }

void judge(const te_profile& profile, const te_train& train) {
    const double error = 1 + double{profile.amplitude_error};
    const double amps = profile.current_source != 0 ? double{train.amplitude} * 1e-3
                                                    : double{train.amplitude} / double{profile.load_low_ohm};
    require(train.command_v >= 0 && train.command_v <= TE_MAX_COMMAND_V);
    require(amps * error * 1e3 <= TE_MAX_PEAK_MA);
    require(amps * error * double{train.width_us} * (1 + double{profile.width_error}) <= TE_MAX_CHARGE_UC);
    require(train.width_us <= TE_MAX_WIDTH_US && train.interval_s >= TE_MIN_INTERVAL_S);
    require(train.pulses >= 1 && train.pulses / double{train.pulse_hz} <= double{train.interval_s});
    require(train.onset_ns >= 0);
}

void step(te_state& state, std::int64_t now) {
    te_reading frame{};
    while (te_frame(&state, &frame) != 0) require(isUnitOrAbsent(frame.R) && isUnitOrAbsent(frame.P));
    te_train train{};
    if (te_next_train(&state, now, &train) == 0) return;
    require(te_fault(&state, now) == 0);
    judge(state.profile, train);
}

}  // namespace

TACTO_FUZZ(EncoderFuzz, const std::uint8_t* data, std::size_t size) {
    static const auto state = std::make_unique<te_state>();
    Input in(data, size);
    const te_profile profile = changed(in);
    if (te_init(state.get(), &profile) != TE_ACCEPTED) return 0;
    if ((size & 1U) != 0) te_rested(state.get());
    std::int64_t now = 1'000'000'000;
    while (!in.over()) {
        const auto kind = in.take<std::uint8_t>();
        // Unsigned, because it may wrap.
        now = (kind & 0x40U) != 0 ? in.take<std::int64_t>()
                                  : static_cast<std::int64_t>(static_cast<std::uint64_t>(now) +
                                                              in.take<std::uint16_t>() * std::uint64_t{1000});
        if ((kind & 3U) == 3) {
            step(*state, now);
            continue;
        }
        const std::uint32_t count = 1 + in.take<std::uint8_t>() % 20;
        std::vector<float> values;
        for (std::size_t i = 0; i < std::size_t{count} * TE_TAXELS; ++i) {
            if (in.over()) break;
            values.push_back((kind & 0x80U) != 0 ? in.take<float>()
                                                 : static_cast<float>(in.take<std::int8_t>()) * 0.1F);
            if (values.size() == std::size_t{count} * ((kind & 3U) == 0   ? profile.axes
                                                       : (kind & 3U) == 1 ? 1
                                                                          : profile.taxels))
                break;
        }
        values.resize(std::size_t{count} * TE_TAXELS);
        te_samples(state.get(), static_cast<te_stream>(kind & 3U), now, 1'000'000, values.data(), count);
    }
    return 0;
}

}  // namespace tacto::fuzz::EncoderFuzz
