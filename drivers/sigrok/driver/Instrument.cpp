#include "drivers/sigrok/driver/Instrument.h"

#include <algorithm>
#include <cmath>

#include "drivers/sigrok/driver/ConfigValues.h"

namespace tacto::sigrok_driver {

namespace {

constexpr unsigned kComplaints = 3;  // with a smaller limit, a single lost answer would end the connection
constexpr unsigned kBeat_ms = 20;

using Key = sigrok::ConfigKey;

Result<std::map<const Key*, Glib::VariantBase>> scanOptions(
    const sigrok::Driver& driver, const std::vector<std::pair<std::string, std::string>>& options) {
    std::map<const Key*, Glib::VariantBase> read;
    for (const auto& [name, text] : options) {
        const Key* key = nullptr;
        std::vector<std::string> known;
        for (const Key* one : driver.scan_options()) {
            known.push_back(one->identifier());
            if (one->identifier() == name) key = one;
        }
        if (key == nullptr) {
            return fail(ErrorCode::InvalidArgument, "libsigrok's {} driver has no option {} (={}); it has {}",
                        driver.name(), name, text, known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")));
        }
        try {
            read[key] = key->parse_string(text);
        } catch (const std::exception&) {
            return fail(ErrorCode::InvalidArgument, "libsigrok's {} driver does not understand {}={}", driver.name(),
                        name, text);
        }
    }
    return read;
}

std::string labelOf(sigrok::HardwareDevice& device) {
    auto text = fmt::format("{} {}", device.vendor(), device.model());
    if (const auto serial = device.serial_number(); !serial.empty()) text += " (serial " + serial + ")";
    if (const auto place = device.connection_id(); !place.empty()) text += " at conn=" + place;
    return text;
}

}  // namespace

Result<std::unique_ptr<Instrument>> Instrument::open(std::shared_ptr<SigrokLibrary> library, const std::string& name,
                                                     const std::vector<std::pair<std::string, std::string>>& options) {
    // Declared before `calls`, so that `calls` is released first: the destructor of `made` also takes calls().
    std::unique_ptr<Instrument> made(new Instrument(library));
    const auto calls = library->calls();
    if (!calls) return failure(calls);
    const auto opened = guarded("the instrument cannot be opened", [&]() -> Result<void> {
        const auto drivers = library->context()->drivers();
        const auto driver = drivers.find(name);
        if (driver == drivers.end()) {
            return fail(ErrorCode::InvalidArgument,
                        "libsigrok has no driver \"{}\"; demo, rigol-ds, siglent-sds and the others that "
                        "`sigrok-cli -L` lists are known",
                        name);
        }
        const auto scan = scanOptions(*driver->second, options);
        if (!scan) return failure(scan);
        const unsigned before = sigrokLog().errors;
        const auto found = driver->second->scan(*scan);
        if (found.empty()) {
            return fail(ErrorCode::NotFound, "libsigrok's {} driver finds no instrument{}", name,
                        sigrokLog().errors == before ? "" : fmt::format(" ({})", sigrokLog().last));
        }
        if (found.size() > 1) {
            std::vector<std::string> labels;
            for (const auto& one : found) labels.push_back(labelOf(*one));
            return fail(ErrorCode::InvalidArgument, "libsigrok's {} driver finds {}: name one with conn=", name,
                        fmt::join(labels, " and "));
        }
        made->device_ = found.front();
        made->device_->open();
        made->readAbilities(name);
        made->session_ = library->context()->create_session();
        made->session_->add_device(made->device_);
        made->session_->add_datafeed_callback(
            [self = made.get()](const std::shared_ptr<sigrok::Device>&, const std::shared_ptr<sigrok::Packet>& packet) {
                self->receive(packet);
            });
        return {};
    });
    if (!opened) return failure(opened);
    if (!*opened) return failure(*opened);
    return made;
}

Instrument::~Instrument() {
    const auto calls = library_->calls();
    // libsigrok refuses to close a device that no longer answers; nothing more can be done then.
    (void)guarded("close", [&] {
        session_.reset();
        if (device_) device_->close();
    });
}

void Instrument::readAbilities(const std::string& driver) {
    auto& a = abilities_;
    a.driver = driver;
    a.vendor = device_->vendor();
    a.model = device_->model();
    a.serial = device_->serial_number();
    a.firmware = device_->version();
    const auto groups = device_->channel_groups();
    for (const auto& channel : device_->channels()) {
        if (channel->type()->id() != SR_CHANNEL_ANALOG) continue;
        std::shared_ptr<sigrok::ChannelGroup> own;
        for (const auto& [name, group] : groups) {
            const auto members = group->channels();
            const bool has = std::ranges::any_of(
                members, [&](const auto& m) { return m->index() == channel->index() && m->name() == channel->name(); });
            if (has && (!own || members.size() == 1)) own = group;
        }
        channels_.push_back(channel);
        groups_.push_back(own);
        auto& can = a.channels.emplace_back();
        can.name = channel->name();
        const auto& settings = settingsOf(channels_.size() - 1);
        can.voltsPerDivision = fractionsOf(settings, Key::VDIV);
        can.probes = numbersOf(settings, Key::PROBE_FACTOR);
        const auto couplings = textsOf(settings, Key::COUPLING);
        can.coupling = std::ranges::find(couplings, "DC") != couplings.end();
    }
    a.timebases = fractionsOf(*device_, Key::TIMEBASE);
    if (const auto divisions = numberOf(*device_, Key::NUM_HDIV); divisions && *divisions >= 1 && *divisions <= 100) {
        a.divisions = static_cast<int>(*divisions);
    }
    a.triggerSources = textsOf(*device_, Key::TRIGGER_SOURCE);
    a.triggerSlope = canSet(*device_, Key::TRIGGER_SLOPE);
    a.triggerLevel = canSet(*device_, Key::TRIGGER_LEVEL);
    a.triggerPosition = canSet(*device_, Key::HORIZ_TRIGGERPOS);
    a.frameLimit = canSet(*device_, Key::LIMIT_FRAMES);
    a.sampleLimit = canSet(*device_, Key::LIMIT_SAMPLES);
    a.dataSources = textsOf(*device_, Key::DATA_SOURCE);
    readRates(*device_, a);
    a.memory = memoryOf(driver, a.model);
}

sigrok::Configurable& Instrument::settingsOf(std::size_t channel) const {
    if (groups_[channel]) return *groups_[channel];
    return *device_;
}

double Instrument::rate() const noexcept {
    const auto rate = numberOf(*device_, Key::SAMPLERATE);
    return rate ? static_cast<double>(*rate) : 0;
}

Result<void> Instrument::prepare(const Wiring& wiring) {
    const auto used = [&](std::size_t channel) { return channel == wiring.voltage || wiring.current == channel; };
    auto done = guarded("choosing channels", [&] {
        for (const auto& channel : device_->channels()) {
            const auto mine = std::ranges::find(channels_, channel);
            channel->set_enabled(mine != channels_.end() && used(static_cast<std::size_t>(mine - channels_.begin())));
        }
    });
    if (!done) return done;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
        if (!used(i)) continue;
        const auto& can = abilities_.channels[i];
        const auto probe = i == wiring.voltage ? wiring.voltageProbe : wiring.currentProbe;
        done = guarded(fmt::format("probe and coupling of {}", can.name), [&] {
            if (probe) settingsOf(i).config_set(Key::PROBE_FACTOR, valueOf(*probe));
            if (can.coupling) settingsOf(i).config_set(Key::COUPLING, valueOf(std::string("DC")));
        });
        if (!done) return done;
    }
    if (!abilities_.dataSources.empty()) {
        const std::string source = wiring.live ? "Live" : "Memory";
        if (std::ranges::find(abilities_.dataSources, source) != abilities_.dataSources.end()) {
            done = guarded("data source " + source, [&] { device_->config_set(Key::DATA_SOURCE, valueOf(source)); });
        }
    }
    return done;
}

Result<void> Instrument::apply(const RecordPlan& plan, const Wiring& wiring) {
    const auto set = [](sigrok::Configurable& on, const char* what, const Key* key, const auto& value) {
        return guarded(what, [&] { on.config_set(key, valueOf(value)); });
    };
    Result<void> done;
    if (abilities_.streams()) {
        done = set(*device_, "sampling rate", Key::SAMPLERATE,
                   static_cast<std::uint64_t>(std::llround(plan.settings.sampleRate.value())));
    } else {
        done = set(*device_, "time base", Key::TIMEBASE, plan.timebase);
        if (done && abilities_.triggerPosition) {
            done = set(*device_, "trigger position", Key::HORIZ_TRIGGERPOS, plan.triggerPosition);
        }
    }
    if (done && plan.voltageScale) {
        done = set(settingsOf(wiring.voltage), "voltage range", Key::VDIV, *plan.voltageScale);
    }
    if (done && plan.currentScale) {
        done = set(settingsOf(*wiring.current), "current range", Key::VDIV, *plan.currentScale);
    }
    if (done && !abilities_.streams() && !wiring.ownTrigger) {
        done = set(*device_, "trigger source", Key::TRIGGER_SOURCE, plan.triggerSource);
        if (done && abilities_.triggerSlope) {
            done = set(*device_, "trigger slope", Key::TRIGGER_SLOPE, std::string(wiring.falling ? "f" : "r"));
        }
        if (done) done = set(*device_, "trigger level", Key::TRIGGER_LEVEL, plan.triggerLevel_V);
    }
    return done;
}

/// A timer on the thread's main context stops the session on the thread that runs it: if another thread stops a
/// session, libsigrok leaves behind a source that points to the session after its end.
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
    // C code calls this function, so no exception may leave it.
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
