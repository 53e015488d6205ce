#include "core/exchange/edf/EdfFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <edflib.h>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>

#include "core/base/Csv.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Printable.h"
#include "core/exchange/edf/EdfNames.h"

namespace tacto {

namespace edf {
std::mutex& edflibTable() {
    static std::mutex table;
    return table;
}
}  // namespace edf

namespace {

using namespace edf;

struct Signal {
    SignalChannel channel;
    double physicalMin, physicalMax;
    int digitalMin, digitalMax;
    std::size_t perRecord;
};

struct Header {
    bool bdf = false, ours = false, simulated = false;
    std::size_t records = 0;
    double record_s = 0;
    std::vector<Signal> signals;  ///< without those of annotations
};

/// Text of a header: ASCII by the format, Latin-1 in some files.
std::string shown(std::string_view field) {
    std::string text(trimmed(field));
    if (isUtf8(text)) return printable(text);
    std::string wide;
    for (const char letter : text) {
        const auto byte = static_cast<unsigned char>(letter);
        if (byte < 0x80) {
            wide += letter;
        } else {
            wide += static_cast<char>(0xC0 | byte >> 6);
            wide += static_cast<char>(0x80 | (byte & 0x3F));
        }
    }
    return printable(wide);
}

std::optional<std::size_t> wholeNumber(std::string_view field, std::size_t most) {
    const auto number = parseNumber(field);
    if (!number || !(*number >= 0 && *number <= static_cast<double>(most)) || *number != std::floor(*number))
        return std::nullopt;
    return static_cast<std::size_t>(*number);
}

/// Checks a header, whose faults EDFlib does not name.
class HeaderReader {
public:
    HeaderReader(std::string name, std::string_view head, std::uintmax_t fileBytes)
        : name_(std::move(name)), head_(head), fileBytes_(fileBytes) {}

    Result<Header> read() {
        if (head_.size() < kHeaderBytes)
            return refuse("has {} bytes; an EDF or BDF file's header has {} or more", head_.size(), kHeaderBytes);
        header_.bdf = head_.starts_with(kBdfMagic);
        if (!header_.bdf && !head_.starts_with(kEdfMagic))
            return refuse("begins neither as an EDF file (\"0\" and seven blanks) nor as a BDF file does");
        const auto reserved = kReserved.in(head_);
        if (reserved.starts_with("EDF+D") || reserved.starts_with("BDF+D"))
            return refuse(
                "is {}, discontinuous: between its records there may be gaps that its readers pass over; a continuous "
                "file ({}+C) is expected",
                reserved.substr(0, 5), reserved.substr(0, 3));
        isPlus_ = reserved.starts_with("EDF+C") || reserved.starts_with("BDF+C");
        const auto signals = wholeNumber(kSignals.in(head_), 9999);
        if (!signals || *signals == 0 || *signals > kMaxSignals)
            return refuseField("number of signals", kSignals.in(head_), fmt::format("1 to {}", kMaxSignals));
        const auto bytes = kHeaderBytes * (*signals + 1);
        if (wholeNumber(kHeaderSize.in(head_), 99'999'999) != bytes)
            return refuseField("size of the header", kHeaderSize.in(head_),
                               fmt::format("{} for {} signals", bytes, *signals));
        if (head_.size() < bytes)
            return refuse("ends in its header: it has {} bytes, and the header of {} signals {}", fileBytes_, *signals,
                          bytes);
        const auto records = wholeNumber(kRecords.in(head_), 99'999'999);
        if (!records || *records == 0) return refuseField("number of records", kRecords.in(head_), "1 or more");
        header_.records = *records;
        const auto duration = parseNumber(kDuration.in(head_));
        if (!duration || !(*duration >= 0 && *duration < 1e8))
            return refuseField("duration of a record", kDuration.in(head_), "0 s or more");
        header_.record_s = *duration;
        std::size_t recordBytes = 0;
        for (std::size_t i = 0; i < *signals; ++i) {
            auto taken = takeSignal(i, *signals, recordBytes);
            if (!taken) return failure(taken);
        }
        return checkSizes(bytes, recordBytes);
    }

private:
    template <class... Args>
    tl::unexpected<Error> refuse(fmt::format_string<Args...> text, Args&&... args) const {
        return fail(ErrorCode::ParseError, "{} {}", name_, fmt::format(text, std::forward<Args>(args)...));
    }
    tl::unexpected<Error> refuseField(std::string_view what, std::string_view field, std::string_view expected) const {
        return refuse("states \"{}\" as its {}; {} is expected", shown(field), what, expected);
    }

    [[nodiscard]] std::string_view fieldOf(const HeaderField& field, std::size_t signal, std::size_t signals) const {
        return head_.substr(kHeaderBytes + field.at * signals + field.bytes * signal, field.bytes);
    }

    Result<void> takeSignal(std::size_t i, std::size_t signals, std::size_t& recordBytes) {
        const auto label = trimmed(fieldOf(kLabel, i, signals));
        const auto called = fmt::format("signal {} (\"{}\")", i + 1, shown(label));
        const auto refuseOf = [&](std::string_view what, const HeaderField& field, std::string_view expected) {
            return refuse("states \"{}\" as the {} of {}; {} is expected", shown(fieldOf(field, i, signals)), what,
                          called, expected);
        };
        const auto perRecord = wholeNumber(fieldOf(kSamples, i, signals), kMaxRecordBytesBdf);
        if (!perRecord || *perRecord == 0) return refuseOf("samples in a record", kSamples, "1 or more");
        recordBytes += *perRecord * (header_.bdf ? 3 : 2);
        if (recordBytes > (header_.bdf ? kMaxRecordBytesBdf : kMaxRecordBytesEdf))
            return refuse("has records of {} bytes or more; at most {} are expected", recordBytes,
                          header_.bdf ? kMaxRecordBytesBdf : kMaxRecordBytesEdf);
        if (isPlus_ && std::ranges::find(kAnnotations, label) != std::end(kAnnotations)) return {};
        const double lowest = header_.bdf ? -8388608 : -32768;
        const auto digital = [&](const HeaderField& field) -> std::optional<int> {
            const auto number = parseNumber(fieldOf(field, i, signals));
            if (!number || !(*number >= lowest && *number < -lowest) || *number != std::floor(*number))
                return std::nullopt;
            return static_cast<int>(*number);
        };
        const auto range = fmt::format("a whole number from {} to {}", lowest, -lowest - 1);
        const auto digitalMin = digital(kDigitalMin), digitalMax = digital(kDigitalMax);
        if (!digitalMin) return refuseOf("digital minimum", kDigitalMin, range);
        if (!digitalMax) return refuseOf("digital maximum", kDigitalMax, range);
        if (*digitalMin >= *digitalMax)
            return refuseOf("digital maximum", kDigitalMax, fmt::format("more than the minimum, {},", *digitalMin));
        const auto physicalMin = parseNumber(fieldOf(kPhysicalMin, i, signals));
        const auto physicalMax = parseNumber(fieldOf(kPhysicalMax, i, signals));
        if (!physicalMin || !std::isfinite(*physicalMin)) return refuseOf("physical minimum", kPhysicalMin, "a number");
        if (!physicalMax || !std::isfinite(*physicalMax)) return refuseOf("physical maximum", kPhysicalMax, "a number");
        if (*physicalMin == *physicalMax)
            return refuse(
                "states {} as physical minimum and maximum of {}: its calibration is 0, every sample would "
                "be the same",
                *physicalMin, called);
        if (!std::isfinite(*physicalMax - *physicalMin))
            return refuseOf("physical maximum", kPhysicalMax, "a range that a number can hold");
        header_.signals.push_back({{shown(label), shown(fieldOf(kUnit, i, signals)), header_.signals.size() + 1},
                                   *physicalMin,
                                   *physicalMax,
                                   *digitalMin,
                                   *digitalMax,
                                   *perRecord});
        return {};
    }

    Result<Header> checkSizes(std::size_t headerBytes, std::size_t recordBytes) {
        // At most 10^8 records of 15 MiB, in 64 bits.
        const std::uintmax_t stated = headerBytes + std::uintmax_t{header_.records} * recordBytes;
        if (stated != fileBytes_)
            return refuse("has {} bytes, and {} by its header ({} records of {} bytes): it is {}", fileBytes_, stated,
                          header_.records, recordBytes,
                          fileBytes_ < stated ? "cut short, or its header is wrong" : "longer than it says");
        if (!header_.signals.empty() && !(header_.record_s > 0))
            return refuse("states 0 s as the duration of a record, and has signals with samples in it");
        takeOrigin();
        return std::move(header_);
    }

    /// Recording: "Startdate dd-MMM-yyyy administration technician equipment".
    void takeOrigin() {
        std::vector<std::string_view> words;
        for (const auto word : split(kRecording.in(head_), ' '))
            if (!word.empty()) words.push_back(word);
        if (words.size() < 5 || !words[4].starts_with(kEquipment)) return;
        header_.ours = true;
        header_.simulated = words[4].ends_with(kSimulatedEquipment);
    }

    const std::string name_;
    const std::string_view head_;
    const std::uintmax_t fileBytes_;
    bool isPlus_ = false;  // has annotations
    Header header_;
};

/// A file that EDFlib has opened.
class OpenEdf {
public:
    OpenEdf() : header_(std::make_unique<edf_hdr_struct>()) {}
    ~OpenEdf() {
        if (open_) edfclose_file(header_->handle);
    }
    OpenEdf(const OpenEdf&) = delete;
    OpenEdf& operator=(const OpenEdf&) = delete;

    bool open(const std::filesystem::path& path) {
        open_ = edfopen_file_readonly(path.c_str(), header_.get(), EDFLIB_DO_NOT_READ_ANNOTATIONS) == 0;
        return open_;
    }
    [[nodiscard]] int error() const noexcept { return header_->filetype; }
    [[nodiscard]] int signals() const noexcept { return header_->edfsignals; }

    /// Hands each digital value of a signal to `take`; false if there are fewer than `count`.
    template <class Take>
    bool each(int signal, std::size_t count, Take&& take) {
        std::array<int, 8192> piece{};
        for (std::size_t done = 0; done < count;) {
            const auto wanted = static_cast<int>(std::min(piece.size(), count - done));
            const int got = edfread_digital_samples(header_->handle, signal, wanted, piece.data());
            if (got <= 0) return false;
            for (int i = 0; i < got; ++i) take(done++, piece[static_cast<std::size_t>(i)]);
        }
        return true;
    }

private:
    std::unique_ptr<edf_hdr_struct> header_;  // 140 KB to 1 MB
    bool open_ = false;
};

}  // namespace

bool beginsAsEdf(std::string_view head) {
    if (head.size() < kHeaderBytes) return false;
    if (head.starts_with(kBdfMagic)) return true;
    const auto signals = wholeNumber(kSignals.in(head), 9999);
    return head.starts_with(kEdfMagic) && signals &&
           wholeNumber(kHeaderSize.in(head), 99'999'999) == kHeaderBytes * (*signals + 1);
}

Result<SignalFile> readEdf(const std::filesystem::path& path) {
    if (auto plain = checkPlainFile(path); !plain) return failure(plain);
    std::error_code error;
    const auto fileBytes = std::filesystem::file_size(path, error);
    std::string head(static_cast<std::size_t>(std::min<std::uintmax_t>(fileBytes, kHeaderBytes * (kMaxSignals + 1))),
                     '\0');
    std::ifstream in(path, std::ios::binary);
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    if (error || !in) return fail(ErrorCode::Io, "{} could not be read", path.string());
    const auto header = HeaderReader(path.string(), head, fileBytes).read();
    if (!header) return failure(header);

    const std::lock_guard alone(edflibTable());
    OpenEdf file;
    if (!file.open(path) || static_cast<std::size_t>(file.signals()) != header->signals.size())
        return fail(ErrorCode::ParseError,
                    "{} is against the format of EDF and BDF files in a way that EDFlib refuses (error {}); EDFbrowser "
                    "shows where",
                    path.string(), file.error());
    SignalFile out{.ours = header->ours};
    if (header->simulated) out.simulated = true;
    std::map<std::size_t, std::vector<const Signal*>, std::greater<>> rates;  // the fastest first
    for (const auto& signal : header->signals) rates[signal.perRecord].push_back(&signal);
    for (const auto& [perRecord, signals] : rates) {
        SignalStream stream{.rate_hz = static_cast<double>(perRecord) / header->record_s,
                            .count = perRecord * header->records,
                            .width = signals.size()};
        stream.samples.t_s.resize(stream.count);
        for (std::size_t k = 0; k < stream.count; ++k)
            stream.samples.t_s[k] = static_cast<double>(k) * header->record_s / static_cast<double>(perRecord);
        stream.samples.values.resize(stream.count * stream.width);
        for (std::size_t c = 0; c < signals.size(); ++c) {
            const auto& signal = *signals[c];
            const double step = (signal.physicalMax - signal.physicalMin) /
                                (static_cast<double>(signal.digitalMax) - static_cast<double>(signal.digitalMin));
            const bool whole =
                file.each(static_cast<int>(signal.channel.number) - 1, stream.count, [&](std::size_t k, int digital) {
                    const bool absent = header->ours && digital == signal.digitalMin;
                    stream.samples.values[k * stream.width + c] =
                        absent ? std::numeric_limits<double>::quiet_NaN()
                               : signal.physicalMin +
                                     step * (static_cast<double>(digital) - static_cast<double>(signal.digitalMin));
                });
            if (!whole)
                return fail(ErrorCode::Io, "{} could not be read to the end of signal {}", path.string(),
                            signal.channel.number);
            stream.channels.push_back(signal.channel);
        }
        out.streams.push_back(std::move(stream));
    }
    return out;
}

}  // namespace tacto
