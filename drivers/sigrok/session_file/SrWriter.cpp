#include "drivers/sigrok/session_file/SrWriter.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <limits>
#include <system_error>

#include "core/base/ProgramVersion.h"
#include "core/base/WholeFile.h"
#include "drivers/sigrok/driver/ConfigValues.h"

namespace tacto::sigrok_driver {

namespace {

constexpr std::size_t kMaxSamples = 500'000'000;  // limited because libsigrok counts the bytes of a packet in an int

bool isLogic(const CaptureChannel& channel) {
    return channel.unit.empty() &&
           std::ranges::all_of(channel.samples, [](float one) { return one == 0.0F || one == 1.0F; });
}

std::string nameOf(const CaptureChannel& channel) { return channel.unit == "A" ? channel.name + " (A)" : channel.name; }

/// Packs the logic channels: bit c of each sample is channel c.
std::vector<unsigned char> packed(const std::vector<const CaptureChannel*>& channels, std::size_t unit) {
    std::vector<unsigned char> bytes(channels.front()->samples.size() * unit, 0);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const auto& samples = channels[c]->samples;
        const auto bit = static_cast<unsigned char>(1U << c % 8);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (samples[i] != 0.0F) bytes[i * unit + c / 8] = static_cast<unsigned char>(bytes[i * unit + c / 8] | bit);
        }
    }
    return bytes;
}

void writeSession(const SigrokLibrary& library, const std::string& file, const Capture& capture) {
    const auto& context = library.context();
    const auto device = context->create_user_device("Tactoscope", "capture", programVersion().version);
    std::vector<const CaptureChannel*> logic, analog;
    for (const auto& channel : capture.channels) (isLogic(channel) ? logic : analog).push_back(&channel);
    unsigned index = 0;
    for (const auto* channel : logic) {
        (void)device->add_channel(index++, sigrok::ChannelType::LOGIC, channel->name);
    }
    // libsigrok 0.5.2 treats an analog channel with index 0 as the end of its list.
    index = std::max(index, 1U);
    std::vector<std::shared_ptr<sigrok::Channel>> analogChannels;
    for (const auto* channel : analog) {
        analogChannels.push_back(device->add_channel(index++, sigrok::ChannelType::ANALOG, nameOf(*channel)));
    }
    const auto output = context->output_formats().at("srzip")->create_output(file, device);
    const auto rate = static_cast<std::uint64_t>(std::llround(capture.rate_hz));
    (void)output->receive(context->create_meta_packet({{sigrok::ConfigKey::SAMPLERATE, valueOf(rate)}}));
    if (!logic.empty()) {
        const std::size_t unit = (logic.size() + 7) / 8;
        auto bytes = packed(logic, unit);
        (void)output->receive(context->create_logic_packet(bytes.data(), bytes.size(), static_cast<unsigned>(unit)));
    }
    for (std::size_t i = 0; i < analog.size(); ++i) {
        auto samples = analog[i]->samples;  // a copy, because libsigrok takes a pointer to non-const samples
        (void)output->receive(context->create_analog_packet({analogChannels[i]}, samples.data(),
                                                            static_cast<unsigned>(samples.size()),
                                                            sigrok::Quantity::VOLTAGE, sigrok::Unit::VOLT, {}));
    }
    (void)output->receive(context->create_end_packet());
}

/// Returns the system's error text within `sentence` (libsigrok quoting libzip's error), or all of `sentence`.
std::string systemReasonIn(const std::string& sentence) {
    for (const int reason : {ENOSPC, EDQUOT, EFBIG, EROFS, EACCES, EIO}) {
        auto said = std::generic_category().message(reason);
        if (sentence.find(said) != std::string::npos) return said;
    }
    return sentence;
}

}  // namespace

Result<void> writeSr(const std::filesystem::path& path, const Capture& capture) {
    const double rate = std::round(capture.rate_hz);
    if (!(rate >= 1 && rate <= 1e15) || std::abs(rate / capture.rate_hz - 1) > 1e-6) {
        return fail(ErrorCode::InvalidArgument, "{}: a .sr holds whole rates from 1 Hz; the capture has {} Hz",
                    path.string(), capture.rate_hz);
    }
    if (capture.samples() > kMaxSamples) {
        return fail(ErrorCode::InvalidArgument, "{}: a .sr is written with at most {} samples; the capture has {}",
                    path.string(), kMaxSamples, capture.samples());
    }
    const auto library = SigrokLibrary::get();
    if (!library) return failure(library);
    const auto calls = (*library)->calls();
    if (!calls) return failure(calls);
    return namedAs(path, replaceWholeFile(path, [&](const std::filesystem::path& draft) -> Result<void> {
                       const auto written = guarded("", [&] { writeSession(**library, draft.string(), capture); });
                       if (written) return {};
                       return fail(ErrorCode::Io, "{}", systemReasonIn(written.error().message));
                   }));
}

}  // namespace tacto::sigrok_driver
