// The session loop of an instrument.
#include <cmath>

#include "drivers/sigrok/driver/ConfigValues.h"
#include "drivers/sigrok/driver/Instrument.h"

namespace tacto::sigrok_driver {

namespace {

constexpr unsigned kComplaints = 3;  // with one less, a single lost answer would end it
constexpr unsigned kBeat_ms = 20;

}  // namespace

/// A source on the thread's main context, so that a session is stopped on the thread that runs it: stopped from
/// another one, libsigrok leaves behind a source that points to the session after its end.
struct Instrument::Beat {
    explicit Beat(Instrument& instrument) : owner(instrument), source(g_timeout_source_new(kBeat_ms)) {
        g_source_set_callback(source, &Beat::call, this, nullptr);
        g_source_attach(source, g_main_context_get_thread_default());
    }
    ~Beat() {
        g_source_destroy(source);
        g_source_unref(source);
    }
    Beat(const Beat&) = delete;
    Beat& operator=(const Beat&) = delete;

    static gboolean call(gpointer data) noexcept {
        Beat& self = *static_cast<Beat*>(data);
        Instrument& owner = self.owner;
        const auto turned = guarded("the acquisition", [&] {
            const SigrokLog& log = sigrokLog();
            if (!owner.error_ && log.errors - owner.complaints_ >= kComplaints) {
                owner.error_ = Error{ErrorCode::Device, "the instrument does not answer as it should: " + log.last};
            }
            if (owner.error_ || owner.sink_->stop()) owner.session_->stop();
        });
        if (!turned && !owner.error_) owner.error_ = turned.error();
        return G_SOURCE_CONTINUE;
    }

    Instrument& owner;
    GSource* const source;
};

void Instrument::receive(const std::shared_ptr<sigrok::Packet>& packet) {
    // Called from C: nothing may escape.
    const auto taken = guarded("taking samples", [&] {
        if (sink_ == nullptr || error_) return;
        const int type = packet->type()->id();
        if (type == SR_DF_FRAME_BEGIN) {
            sink_->frameBegin();
            return;
        }
        if (type == SR_DF_FRAME_END) {
            sink_->frameEnd();
            return;
        }
        if (type != SR_DF_ANALOG) return;
        const auto analog = std::dynamic_pointer_cast<sigrok::Analog>(packet->payload());
        if (!analog || analog->unit()->id() != SR_UNIT_VOLT) return;
        complaints_ = sigrokLog().errors;
        const auto members = analog->channels();
        if (members.empty() || analog->num_samples() == 0) return;
        buffer_.resize(std::size_t{analog->num_samples()} * members.size());
        analog->get_data_as_float(buffer_.data());
        const double resolution = analog->is_digits_decimal() ? std::pow(10.0, -analog->digits()) : 0;
        for (std::size_t m = 0; m < members.size(); ++m) {
            const auto mine = std::ranges::find(channels_, members[m]);
            if (mine == channels_.end()) continue;
            const auto channel = static_cast<std::size_t>(mine - channels_.begin());
            if (members.size() == 1) {
                sink_->samples(channel, buffer_, resolution);
                continue;
            }
            std::vector<float> own(analog->num_samples());
            for (std::size_t i = 0; i < own.size(); ++i) own[i] = buffer_[i * members.size() + m];
            sink_->samples(channel, own, resolution);
        }
    });
    if (!taken && !error_) error_ = taken.error();
}

Result<void> Instrument::run(const Sink& sink, std::uint64_t frames, std::uint64_t samples) {
    sink_ = &sink;
    error_.reset();
    complaints_ = sigrokLog().errors;
    const auto ran = guarded("the acquisition", [&] {
        if (abilities_.frameLimit && frames > 0) device_->config_set(sigrok::ConfigKey::LIMIT_FRAMES, valueOf(frames));
        if (abilities_.sampleLimit && samples > 0)
            device_->config_set(sigrok::ConfigKey::LIMIT_SAMPLES, valueOf(samples));
        session_->start();
        const Beat beat(*this);
        session_->run();
    });
    sink_ = nullptr;
    if (error_) return tl::unexpected<Error>(*error_);
    return ran;
}

}  // namespace tacto::sigrok_driver
