#include "drivers/sigrok/session_file/SrReader.h"

#include <algorithm>
#include <limits>
#include <zlib.h>

#include "drivers/sigrok/driver/ConfigValues.h"

namespace tacto::sigrok_driver {

namespace {

/// Gives this thread a main context of its own while a session runs: see SigrokThread.cpp.
class OwnMainContext {
public:
    OwnMainContext() : context_(g_main_context_new()) { g_main_context_push_thread_default(context_); }
    ~OwnMainContext() {
        g_main_context_pop_thread_default(context_);
        g_main_context_unref(context_);
    }
    OwnMainContext(const OwnMainContext&) = delete;
    OwnMainContext& operator=(const OwnMainContext&) = delete;

private:
    GMainContext* const context_;
};

/// Checks, piece by piece, that the bytes of one channel match the archive's sizes and checksums.
class PieceCheck {
public:
    explicit PieceCheck(const std::vector<SrPiece>& pieces) : pieces_(pieces) {}

    /// Returns false if there are too many bytes, or if a finished piece does not match its checksum.
    [[nodiscard]] bool add(const void* data, std::size_t bytes) {
        const auto* from = static_cast<const Bytef*>(data);
        while (bytes > 0) {
            while (piece_ < pieces_.size() && at_ == pieces_[piece_].bytes) {
                if (crc_ != pieces_[piece_].crc) return false;
                next();
            }
            if (piece_ == pieces_.size()) return false;
            const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, pieces_[piece_].bytes - at_));
            crc_ = ::crc32_z(crc_, from, part);
            at_ += part;
            from += part;
            bytes -= part;
        }
        return true;
    }
    [[nodiscard]] bool complete() {
        while (piece_ < pieces_.size() && at_ == pieces_[piece_].bytes && crc_ == pieces_[piece_].crc) next();
        return piece_ == pieces_.size();
    }

private:
    void next() {
        ++piece_;
        at_ = 0;
        crc_ = 0;
    }
    const std::vector<SrPiece>& pieces_;
    std::size_t piece_ = 0;
    std::uint64_t at_ = 0;
    uLong crc_ = 0;
};

class SampleReader {
public:
    SampleReader(const SrLayout& layout, const ReadWatch& watch, std::string file)
        : layout_(layout), watch_(watch), file_(std::move(file)), logicCheck_(layout.logic) {
        for (const auto& pieces : layout.analog) analogChecks_.emplace_back(pieces);
    }

    [[nodiscard]] Result<Capture> read() {
        const auto library = SigrokLibrary::get();
        if (!library) return failure(library);
        const OwnMainContext own;
        const auto done = guarded(file_ + " cannot be read", [&]() -> Result<void> {
            std::shared_ptr<sigrok::Session> session;
            {
                const auto calls = (*library)->calls();
                if (!calls) return failure(calls);
                session = (*library)->context()->load_session(file_);
            }
            session_ = session.get();
            if (auto prepared = prepare(); !prepared) return prepared;
            session->add_datafeed_callback([this](const auto&, const auto& packet) { receive(*packet); });
            session->start();
            session->run();
            const auto calls = (*library)->calls();
            session.reset();
            return {};
        });
        session_ = nullptr;
        // libsigrok does not tell a damaged file from its own faults; here only the file can be the cause.
        if (!done) return fail(ErrorCode::ParseError, "{}", done.error().message);
        if (!*done) return failure(*done);
        if (error_) return tl::unexpected<Error>(*error_);
        if (!logicCheck_.complete() || !std::ranges::all_of(analogChecks_, [](auto& one) { return one.complete(); })) {
            return damaged();
        }
        return std::move(capture_);
    }

private:
    [[nodiscard]] tl::unexpected<Error> damaged() const {
        return fail(ErrorCode::ParseError, "{}: its samples are damaged or cut short after {} of {} bytes", file_,
                    done_, layout_.bytes);
    }

    Result<void> prepare() {
        const auto devices = session_->devices();
        if (devices.size() != 1)
            return fail(ErrorCode::ParseError, "{}: {} devices; one was expected", file_, devices.size());
        const auto& device = *devices.front();
        capture_.rate_hz = static_cast<double>(numberOf(device, sigrok::ConfigKey::SAMPLERATE).value_or(0));
        capture_.trigger_s = std::numeric_limits<double>::quiet_NaN();
        std::size_t analog = 0;
        for (const auto& channel : devices.front()->channels()) {
            const bool isLogic = channel->type()->id() == SR_CHANNEL_LOGIC;
            if (isLogic && (!channel->enabled() || channel->index() >= layout_.logicChannels)) continue;
            if (!isLogic && analog == layout_.analog.size()) continue;
            auto& into = capture_.channels.emplace_back();
            into.name = channel->name();
            std::uint64_t samples = 0;
            if (isLogic) {
                logicBits_.push_back(channel->index());
                logicTargets_.push_back(capture_.channels.size() - 1);
                into.high = 0;
                samples = SrLayout::sum(layout_.logic) / layout_.unitSize;
            } else {
                into.unit = "V";
                if (into.name.ends_with(" (A)")) {
                    into.unit = "A";
                    into.name.resize(into.name.size() - 4);
                }
                analogChannels_.push_back(channel);
                analogTargets_.push_back(capture_.channels.size() - 1);
                samples = SrLayout::sum(layout_.analog[analog++]) / sizeof(float);
            }
            into.samples.reserve(static_cast<std::size_t>(samples));
        }
        return {};
    }

    void receive(sigrok::Packet& packet) {
        // C code calls this function, so no exception may leave it.
        if (error_) return;
        const auto taken = guarded(file_, [&]() -> Result<void> {
            const int type = packet.type()->id();
            if (type != SR_DF_ANALOG && type != SR_DF_LOGIC) return {};
            const auto payload = packet.payload();
            auto stored = type == SR_DF_ANALOG ? takeAnalog(dynamic_cast<sigrok::Analog&>(*payload))
                                               : takeLogic(dynamic_cast<sigrok::Logic&>(*payload));
            if (!stored) return stored;
            return keepReading(watch_, static_cast<double>(done_) / static_cast<double>(layout_.bytes), file_);
        });
        if (!taken) error_ = taken.error();
        if (taken && !*taken) error_ = taken->error();
        if (error_) (void)guarded("stop", [&] { session_->stop(); });
    }

    Result<void> takeAnalog(sigrok::Analog& analog) {
        const auto channels = analog.channels();
        const auto mine =
            channels.size() == 1 ? std::ranges::find(analogChannels_, channels.front()) : analogChannels_.end();
        if (mine == analogChannels_.end()) return damaged();
        const auto which = static_cast<std::size_t>(mine - analogChannels_.begin());
        buffer_.resize(analog.num_samples());
        analog.get_data_as_float(buffer_.data());
        if (!analogChecks_[which].add(buffer_.data(), buffer_.size() * sizeof(float))) return damaged();
        auto& into = capture_.channels[analogTargets_[which]].samples;
        into.insert(into.end(), buffer_.begin(), buffer_.end());
        done_ += buffer_.size() * sizeof(float);
        return {};
    }

    Result<void> takeLogic(sigrok::Logic& logic) {
        const auto* const bytes = static_cast<const unsigned char*>(logic.data_pointer());
        const std::size_t unit = logic.unit_size();
        if (unit != layout_.unitSize || !logicCheck_.add(bytes, logic.data_length())) return damaged();
        const std::size_t count = logic.data_length() / unit;
        for (std::size_t c = 0; c < logicBits_.size(); ++c) {
            auto& into = capture_.channels[logicTargets_[c]].samples;
            const std::size_t byte = logicBits_[c] / 8;
            const unsigned bit = logicBits_[c] % 8;
            const std::size_t before = into.size();
            into.resize(before + count);
            for (std::size_t i = 0; i < count; ++i) {
                into[before + i] = static_cast<float>(static_cast<unsigned>(bytes[i * unit + byte]) >> bit & 1U);
            }
        }
        done_ += logic.data_length();
        return {};
    }

    const SrLayout& layout_;
    const ReadWatch& watch_;
    const std::string file_;
    sigrok::Session* session_ = nullptr;
    Capture capture_;
    std::vector<std::shared_ptr<sigrok::Channel>> analogChannels_;
    std::vector<std::size_t> analogTargets_, logicTargets_;  // index into capture_.channels
    std::vector<unsigned> logicBits_;
    PieceCheck logicCheck_;
    std::vector<PieceCheck> analogChecks_;
    std::vector<float> buffer_;
    std::uint64_t done_ = 0;
    std::optional<Error> error_;
};

/// Cuts all channels to the shortest: unequal lengths come from an interrupted acquisition.
void evenOut(CaptureReading& reading, const std::string& file) {
    auto& channels = reading.capture.channels;
    const auto size = [](const CaptureChannel& one) { return one.samples.size(); };
    const auto [least, greatest] = std::ranges::minmax_element(channels, {}, size);
    if (least == channels.end() || size(*least) == size(*greatest)) return;
    const CaptureChannel &shortest = *least, &longest = *greatest;
    reading.warnings.push_back(
        fmt::format("{}: {} ends after {} samples, {} after {}: all are taken to the shorter one", file, shortest.name,
                    size(shortest), longest.name, size(longest)));
    const std::size_t most = size(shortest);
    for (auto& channel : channels) channel.samples.resize(most);
}

}  // namespace

Result<CaptureReading> readSr(const SrLayout& layout, const ReadWatch& watch, const std::string& file) {
    auto capture = SampleReader(layout, watch, file).read();
    if (!capture) return failure(capture);
    CaptureReading reading;
    reading.capture = std::move(*capture);
    evenOut(reading, file);
    return reading;
}

}  // namespace tacto::sigrok_driver
