#include "core/exchange/edf/EdfExport.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/chrono.h>
#include <set>
#include <span>
#include <unistd.h>

#include "core/base/Clock.h"
#include "core/base/JsonText.h"
#include "core/base/Printable.h"
#include "core/base/WholeFile.h"
#include "core/exchange/ExportMoments.h"
#include "core/exchange/SlotFinder.h"
#include "core/exchange/edf/EdfGrid.h"
#include "core/exchange/edf/EdfNames.h"

namespace tacto {

namespace {

using namespace edf;

struct PlannedSignal {
    std::string label, unit;
    Scale scale;
};

/// A stream on the grid.
struct PlannedStream {
    const ExportStream* stream;
    std::vector<PlannedSignal> signals;
    std::size_t perRecord = 0;
    std::size_t at = 0;  ///< of its first sample in a record, in samples of all signals
    GridCounts counts;

    [[nodiscard]] double slotRate_hz(double record_s) const { return static_cast<double>(perRecord) / record_s; }
};

struct Annotation {
    double onset_s;
    double duration_s;  ///< NaN: none
    std::string text;
};

/// What a header's field can hold: printable ASCII, cut.
std::string ascii(std::string_view text, std::size_t bytes) {
    std::string out(printable(text));
    for (auto& c : out)
        if (c < ' ' || c > '~') c = '_';
    return out.substr(0, bytes);
}

/// At most kMaxAnnotationText bytes, and no part of a character.
std::string noteText(std::string_view text) {
    auto out = printable(text);
    if (out.size() <= kMaxAnnotationText) return out;
    auto end = kMaxAnnotationText;
    while (end > 0 && (static_cast<unsigned char>(out[end]) & 0xC0) == 0x80) --end;
    return out.substr(0, end);
}

/// An annotation: "+1.5" 0x15 "2" 0x14 "text" 0x14 0.
std::string annotationBytes(const Annotation& note) {
    auto out = fmt::format("{:+.4f}", note.onset_s);
    if (std::isfinite(note.duration_s)) out += fmt::format("\x15{:.4f}", note.duration_s);
    out += '\x14' + note.text + '\x14';
    out += '\0';
    return out;
}

/// Finds the stretches of more than a second in which a channel, or all of a stream, has no value.
class AbsenceFinder {
public:
    AbsenceFinder(std::string_view stream, std::span<const PlannedSignal> signals, double slot_s)
        : stream_(stream), slot_s_(slot_s), since_s_(signals.size(), 0) {
        for (const auto& signal : signals) labels_.push_back(signal.label);
    }

    void feed(double t_s, std::span<const double> values) {
        bool late = false;
        for (std::size_t c = 0; c < since_s_.size(); ++c)
            late = late || (t_s - since_s_[c] > kNoted_s && std::isfinite(values[c]));
        if (late) note(t_s, [&](std::size_t c) { return std::isfinite(values[c]); });
        for (std::size_t c = 0; c < since_s_.size(); ++c)
            if (std::isfinite(values[c])) since_s_[c] = t_s + slot_s_;
    }
    /// The recording ends at `end_s`; adds all that was found.
    void end(double end_s, std::vector<Annotation>& to) {
        note(end_s, [](std::size_t) { return true; });
        std::ranges::move(found_, std::back_inserter(to));
    }

private:
    static constexpr double kNoted_s = 1;

    template <class IsThere>
    void note(double t_s, const IsThere& isThere) {
        bool all = true;
        for (std::size_t c = 0; c < since_s_.size(); ++c) all = all && isThere(c) && since_s_[c] == since_s_[0];
        for (std::size_t c = 0; c < (all ? 1 : since_s_.size()); ++c)
            if (isThere(c) && t_s - since_s_[c] > kNoted_s)
                found_.push_back({since_s_[c], t_s - since_s_[c], noteText("absent " + (all ? stream_ : labels_[c]))});
    }

    std::string stream_;
    double slot_s_;
    std::vector<std::string> labels_;
    std::vector<double> since_s_;  // from when on each channel has no value
    std::vector<Annotation> found_;
};

class EdfWriter {
public:
    EdfWriter(const ExportSource& source, bool bdf, ExportReport& report)
        : source_(source), bytes_(bdf ? 3 : 2), bdf_(bdf), report_(report) {}

    Result<void> write(const std::filesystem::path& path) {
        plan();
        if (auto looked = look(); !looked) return looked;
        lay();
        auto file = FileOut::create(path);
        if (!file) return namedAs(path, failure(file));
        if (auto written = file->write(header()); !written) return namedAs(path, written);
        file_ = file->descriptor();
        const auto end = headerBytes() + records_ * recordBytes_;
        if (::ftruncate(file_, static_cast<off_t>(end)) != 0) return because(path);
        for (const auto& planned : streams_)
            if (auto written = writeStream(planned); !written) return namedAs(path, written);
        if (auto written = namedAs(path, writeAnnotations()); !written) return written;
        report();
        return {};
    }

private:
    static constexpr double kMaxLost = 0.01;
    // More places for a sample than these are out of proportion, unless they take little.
    static constexpr double kMaxPlaces = 50, kLittleBytes = 64 << 20;

    static Result<void> because(const std::filesystem::path& path) {
        return namedAs(path, fail(ErrorCode::Io, "{}", std::strerror(errno)));
    }
    [[nodiscard]] std::size_t maxRecordBytes() const { return bdf_ ? kMaxRecordBytesBdf : kMaxRecordBytesEdf; }
    /// For samples of signals in a record.
    [[nodiscard]] double room() const {
        return static_cast<double>((maxRecordBytes() - kMaxAnnotationSignals * kAnnotationBytes) / bytes_);
    }
    [[nodiscard]] std::size_t notesPerSignal() const { return kAnnotationBytes / bytes_; }

    /// Chooses the streams that have a rate and a range that a header can state, and the record's duration.
    void plan() {
        std::size_t signals = 0;
        double taken = 0;  // samples of the shortest record
        for (const auto& stream : source_.streams()) {
            PlannedStream planned{.stream = &stream, .signals = {}, .counts = {}};
            std::string why;
            if (!(rateOf(stream) > 0)) why = "it has no rate: it has fewer than 2 samples";
            for (const auto& channel : stream.channels) {
                const auto scale = scaleFor(channel.least, channel.most, channel.whole, int(8 * bytes_));
                if (!scale)
                    why = fmt::format("{} goes from {:.6g} to {:.6g} {}, which a header of {} cannot state",
                                      channel.name, channel.least, channel.most, channel.unit, name());
                if (scale) planned.signals.push_back({labelOf(stream, channel), channel.unit, *scale});
            }
            if (signals + stream.channels.size() > kMaxSignals - kMaxAnnotationSignals)
                why = fmt::format("{} holds at most {} signals", name(), kMaxSignals - kMaxAnnotationSignals);
            const double wanted = static_cast<double>(stream.channels.size()) * (rateOf(stream) * kMinRecord_s + 1);
            if (why.empty() && !(taken + wanted <= room()))
                why = fmt::format("at {:.6g} Hz it has no room in a record of {}, which holds {} samples in {} s",
                                  rateOf(stream), name(), room(), kMinRecord_s);
            if (!why.empty()) {
                leaveOut(stream, why);
                continue;
            }
            taken += wanted;
            signals += stream.channels.size();
            streams_.push_back(std::move(planned));
        }
    }

    static double rateOf(const ExportStream& stream) {
        return stream.rate_hz > 0 ? stream.rate_hz : stream.declaredRate_hz;
    }
    [[nodiscard]] const char* name() const { return bdf_ ? "BDF" : "EDF"; }
    /// Leaves out a stream that would be almost nothing but absent values until `end_s`; returns whether it was.
    bool leaveOutIfSparse(const PlannedStream& planned, double end_s) {
        const auto& stream = *planned.stream;
        const double places = end_s * planned.slotRate_hz(record_s_);
        const double bytes = places * static_cast<double>(stream.channels.size() * bytes_);
        if (bytes <= kLittleBytes || places <= kMaxPlaces * static_cast<double>(stream.samples)) return false;
        leaveOut(stream, fmt::format("its {} samples would be spread over {:.6g} places, up to {:.6g} s at {:.6g} Hz",
                                     stream.samples, places, end_s, rateOf(stream)));
        return true;
    }
    void leaveOut(const ExportStream& stream, std::string why) {
        report_.leftOut.push_back({stream.name, std::move(why)});
    }

    void chooseRecord() {
        std::vector<double> rates;  // of each signal
        for (const auto& planned : streams_) rates.insert(rates.end(), planned.signals.size(), rateOf(*planned.stream));
        record_s_ = recordDuration_s(rates, room());
        for (auto& planned : streams_)
            planned.perRecord =
                std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(rateOf(*planned.stream) * record_s_)));
    }

    /// A channel of the second stream of a kind is called after that stream.
    std::string labelOf(const ExportStream& stream, const ExportChannel& channel) {
        auto label = channel.name;
        if (stream.name != stream.kind && label.starts_with(stream.kind))
            label = stream.name + label.substr(stream.kind.size());
        label = ascii(label, label.size());
        for (int i = 1; label.size() > kLabel.bytes || labels_.contains(label); ++i) {
            const auto number = fmt::format("~{}", i);
            label = label.substr(0, kLabel.bytes - number.size()) + number;
        }
        labels_.insert(label);
        return label;
    }

    /// Looks how each stream lies on the grid, and for what is absent for more than a second.
    Result<void> look() {
        for (bool all = false; !all;) {
            chooseRecord();
            auto looked = lookAtSlots();
            if (!looked) return failure(looked);
            all = *looked;
        }
        records_ = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(end_s_ / record_s_ - 1e-9)));
        constexpr std::uint64_t kMaxRecords = 99'999'999;  // eight digits
        if (records_ > kMaxRecords)
            return fail(ErrorCode::Unsupported, "{} holds at most {} records of {} s, and the session lasts {:.6g} s",
                        name(), kMaxRecords, record_s_, end_s_);
        return forEachMomentInWords(source_, [&](const ExportMoment&) -> Result<void> {
            ++notes_;
            return {};
        });
    }

    /// Looks for what is absent for more than a second, and leaves out what is not sampled regularly; returns whether
    /// nothing was.
    Result<bool> lookAtSlots() {
        const auto before = streams_.size();
        end_s_ = source_.duration_s();
        absences_.clear();
        std::vector<AbsenceFinder> finders;
        for (auto planned = streams_.begin(); planned != streams_.end();) {
            const auto& stream = *planned->stream;
            const auto width = stream.channels.size();
            const double slot_s = 1 / planned->slotRate_hz(record_s_);
            SlotFinder slots(planned->slotRate_hz(record_s_), rateOf(stream));
            // Of a stream without absent values one channel says everything, and its stamps are enough.
            const bool absentSome =
                std::ranges::any_of(stream.channels, [](const auto& c) { return c.absent + c.infinite > 0; });
            const auto seen = absentSome ? width : 1;
            AbsenceFinder absent(stream.name, std::span(planned->signals).first(seen), slot_s);
            double last_s = 0;
            const auto take = [&](double t_s, std::uint64_t slot, std::span<const double> values) {
                last_s = std::max(last_s, t_s);
                absent.feed(static_cast<double>(slot) * slot_s, values);
            };
            const auto lookAtAll = [&](const SampleBlock& block) -> Result<void> {
                for (std::size_t i = 0; i < block.samples(); ++i)
                    if (const auto place = slots.next(block.t_s[i]))
                        take(block.t_s[i], place->slot, std::span(block.values).subspan(i * width, width));
                return {};
            };
            const auto lookAtStamps = [&](std::span<const double> t_s) -> Result<void> {
                for (std::size_t i = 0; i < t_s.size();) {
                    const auto more = slots.follow(t_s.subspan(i));
                    const bool placed = more > 0 || slots.next(t_s[i]);
                    i += std::max<std::size_t>(1, more);
                    if (placed) take(t_s[i - 1], slots.lastSlot(), t_s.subspan(i - 1, 1));
                }
                return {};
            };
            auto read =
                absentSome ? source_.forEachChunk(stream, lookAtAll) : source_.forEachStamps(stream, lookAtStamps);
            if (!read) return failure(read);
            planned->counts = slots.counts();
            const auto samples = static_cast<double>(stream.samples);
            if (static_cast<double>(planned->counts.dropped) > kMaxLost * samples) {
                leaveOut(stream, fmt::format("it is not sampled regularly: {} of {} samples would share the place of "
                                             "another",
                                             planned->counts.dropped, stream.samples));
                planned = streams_.erase(planned);
                continue;
            }
            if (leaveOutIfSparse(*planned, last_s + slot_s)) {
                planned = streams_.erase(planned);
                continue;
            }
            end_s_ = std::max(end_s_, last_s + slot_s);
            finders.push_back(std::move(absent));
            ++planned;
        }
        std::erase_if(streams_, [&](const auto& planned) { return leaveOutIfSparse(planned, end_s_); });
        for (auto& finder : finders) finder.end(end_s_, absences_);
        return streams_.size() == before;
    }

    /// Gives everything its place in a record.
    void lay() {
        notes_ += absences_.size();
        noteSignals_ = std::min<std::uint64_t>((notes_ + records_ - 1) / records_ + 1, kMaxAnnotationSignals);
        std::size_t samples = 0;
        for (auto& planned : streams_) {
            planned.at = samples;
            samples += planned.perRecord * planned.signals.size();
        }
        notesAt_ = samples * bytes_;
        recordBytes_ = notesAt_ + noteSignals_ * notesPerSignal() * bytes_;
    }

    [[nodiscard]] std::size_t signalCount() const {
        std::size_t count = noteSignals_;
        for (const auto& planned : streams_) count += planned.signals.size();
        return count;
    }
    [[nodiscard]] std::uint64_t headerBytes() const { return kHeaderBytes * (signalCount() + 1); }

    [[nodiscard]] std::string header() const {
        std::string out;
        const auto field = [&](std::string_view text, std::size_t bytes) {
            out += fmt::format("{:<{}}", ascii(text, bytes), bytes);
        };
        const auto wall = wallTimeFrom(source_.wallStart());
        const auto utc = wall ? fmt::gmtime(std::chrono::system_clock::to_time_t(*wall)) : std::tm{};
        constexpr const char* kMonths[] = {"JAN", "FEB", "MAR", "APR", "MAY", "JUN",
                                           "JUL", "AUG", "SEP", "OCT", "NOV", "DEC"};
        const auto date = wall ? fmt::format("{:02}-{}-{}", utc.tm_mday, kMonths[utc.tm_mon], 1900 + utc.tm_year) : "X";
        out += bdf_ ? kBdfMagic : kEdfMagic;
        field(patient() + " X X X", 80);
        field(fmt::format("Startdate {} X X {} {}", date, equipment(date.size()), source_.chainHead().substr(0, 16)),
              80);
        field(wall ? fmt::format("{:02}.{:02}.{:02}", utc.tm_mday, utc.tm_mon + 1, utc.tm_year % 100) : "01.01.85", 8);
        field(wall ? fmt::format("{:02}.{:02}.{:02}", utc.tm_hour, utc.tm_min, utc.tm_sec) : "00.00.00", 8);
        field(fmt::format("{}", headerBytes()), 8);
        field(std::string(name()) + "+C", 44);
        field(fmt::format("{}", records_), 8);
        field(fmt::format("{}", record_s_), 8);
        field(fmt::format("{}", signalCount()), 4);
        const auto each = [&](std::size_t bytes, const auto& ofSignal, std::string_view ofNotes) {
            for (const auto& planned : streams_)
                for (const auto& signal : planned.signals) field(ofSignal(planned, signal), bytes);
            for (std::size_t i = 0; i < noteSignals_; ++i) field(ofNotes, bytes);
        };
        using P = PlannedStream;
        using S = PlannedSignal;
        const Scale all = *scaleFor(kNaN, kNaN, true, int(8 * bytes_));
        const auto marks = source_.marksText();
        each(
            kLabel.bytes, [](const P&, const S& s) { return s.label; }, kAnnotations[bdf_ ? 1 : 0]);
        each(
            kTransducer.bytes, [&](const P& p, const S&) { return p.stream->title + "; " + marks; }, "");
        each(
            kUnit.bytes, [](const P&, const S& s) { return s.unit; }, "");
        each(
            kPhysicalMin.bytes, [](const P&, const S& s) { return s.scale.physicalMin; }, "-1");
        each(
            kPhysicalMax.bytes, [](const P&, const S& s) { return s.scale.physicalMax; }, "1");
        each(
            kDigitalMin.bytes, [&](const P&, const S&) { return all.physicalMin; }, all.physicalMin);
        each(
            kDigitalMax.bytes, [&](const P&, const S&) { return all.physicalMax; }, all.physicalMax);
        each(
            80, [](const P&, const S&) { return std::string(kAbsentNote); }, "");
        each(
            kSamples.bytes, [](const P& p, const S&) { return fmt::format("{}", p.perRecord); },
            fmt::format("{}", notesPerSignal()));
        each(
            32, [](const P&, const S&) { return std::string(); }, "");
        return out;
    }

    /// The participant of a session outside a study, as that was given; else X: the code of a person leaves no study.
    [[nodiscard]] std::string patient() const {
        auto code = ascii(textOr(valueOr(source_.description(), "parameters"), "participant"), 20);
        std::ranges::replace(code, ' ', '_');
        return code.empty() ? "X" : code;
    }
    /// Without the commit where the field is too short for it.
    [[nodiscard]] std::string equipment(std::size_t dateBytes) const {
        auto version = ascii(source_.version(), 60);
        std::ranges::replace(version, ' ', '_');
        const auto end = source_.simulated() ? kSimulatedEquipment : std::string_view();
        const auto beside =
            std::string_view("Startdate  X X  ").size() + dateBytes + 16 + kEquipment.size() + end.size();
        if (beside + version.size() > kRecording.bytes) version = version.substr(0, version.find('+'));
        return fmt::format("{}{}{}", kEquipment, version.substr(0, kRecording.bytes - beside), end);
    }

    [[nodiscard]] Result<void> writeAt(std::uint64_t at, std::string_view bytes) const {
        while (!bytes.empty()) {
            const auto written = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(at));
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) return fail(ErrorCode::Io, "{}", std::strerror(errno));
            at += static_cast<std::uint64_t>(written);
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
        return {};
    }

    void putDigital(std::string& into, std::size_t sample, std::span<const int> values) const {
        auto* to = into.data() + sample * bytes_;
        if (bdf_)
            for (const int value : values) std::memcpy(std::exchange(to, to + 3), &value, 3);
        else
            for (const int value : values) std::memcpy(std::exchange(to, to + 2), &value, 2);
    }

    /// Writes a stream's part of every record.
    Result<void> writeStream(const PlannedStream& planned) const {
        const auto width = planned.signals.size();
        std::string absent(planned.perRecord * width * bytes_, '\0');
        std::vector<int> digital(planned.perRecord);
        for (std::size_t c = 0; c < width; ++c) {
            std::ranges::fill(digital, planned.signals[c].scale.digitalMin);
            putDigital(absent, c * planned.perRecord, digital);
        }
        std::string piece = absent;
        std::uint64_t record = 0;
        const auto moveTo = [&](std::uint64_t wanted) -> Result<void> {
            for (; record < wanted; ++record) {
                const auto at = headerBytes() + record * recordBytes_ + planned.at * bytes_;
                if (auto written = writeAt(at, piece); !written) return written;
                piece = absent;
                if (auto on = source_.goOn(); !on) return on;
            }
            return {};
        };
        std::uint64_t first = 0;  // slot of the record
        // Puts samples that stand one after the other.
        const auto put = [&](std::uint64_t slot, std::size_t samples, const double* values) -> Result<void> {
            while (samples > 0) {
                if (slot - first >= planned.perRecord) {
                    if (auto moved = moveTo(slot / planned.perRecord); !moved) return moved;
                    first = record * planned.perRecord;
                }
                const auto some = std::min<std::size_t>(samples, first + planned.perRecord - slot);
                const auto to = std::span(digital).first(some);
                for (std::size_t c = 0; c < width; ++c) {
                    planned.signals[c].scale.digital(values + c, width, to);
                    putDigital(piece, c * planned.perRecord + (slot - first), to);
                }
                slot += some;
                samples -= some;
                values += some * width;
            }
            return {};
        };
        SlotFinder finder(planned.slotRate_hz(record_s_), rateOf(*planned.stream));
        std::vector<double> before(width, kNaN);
        auto read = source_.forEachChunk(*planned.stream, [&](const SampleBlock& block) -> Result<void> {
            const auto* values = block.values.data();
            std::uint64_t begin = 0;  // slot of the first of the samples that have yet to be put
            std::size_t from = 0, to = 0;
            const auto putThem = [&] { return put(begin, to - from, values + from * width); };
            for (std::size_t i = 0; i < block.samples(); ++i) {
                if (to > from && i == to) i = to += finder.follow(std::span(block.t_s).subspan(i));
                if (i == block.samples()) break;
                const auto place = finder.next(block.t_s[i]);
                if (!place) continue;
                if (auto done = putThem(); !done) return done;
                if (place->slipped) {
                    const auto* earlier = to > from ? values + (to - 1) * width : before.data();
                    if (auto done = put(place->slot - 1, 1, earlier); !done) return done;
                }
                begin = place->slot;
                from = i;
                to = i + 1;
            }
            if (to > from) std::copy_n(values + (to - 1) * width, width, before.begin());
            return putThem();
        });
        return read ? moveTo(records_) : read;
    }

    /// Writes the time of every record, and an annotation a record and signal.
    Result<void> writeAnnotations() {
        std::uint64_t record = 0, signal = 0;
        const auto size = notesPerSignal() * bytes_;
        std::string area(noteSignals_ * size, '\0');
        const auto begin = [&] {
            std::ranges::fill(area, '\0');
            const auto time =
                fmt::format("+{}\x14\x14", std::round(static_cast<double>(record) * record_s_ * 100) / 100);
            time.copy(area.data(), time.size());
        };
        const auto end = [&]() -> Result<void> {
            auto written = writeAt(headerBytes() + record * recordBytes_ + notesAt_, area);
            ++record;
            signal = 0;
            begin();
            return written ? source_.goOn() : written;
        };
        const auto add = [&](const Annotation& note) -> Result<void> {
            if (signal == noteSignals_)
                if (auto ended = end(); !ended) return ended;
            if (record >= records_) {
                ++unplaced_;
                return {};
            }
            const auto bytes = annotationBytes(note);
            const auto at = signal * size;
            // Behind the record's time, which ends with a zero.
            const auto from = signal == 0 ? area.find('\0') + 1 : at;
            bytes.copy(area.data() + from, bytes.size());
            ++signal;
            return {};
        };
        begin();
        auto read = forEachMomentInWords(source_, [&](const ExportMoment& moment) {
            return add({moment.time_s, kNaN, noteText(moment.text)});
        });
        if (!read) return read;
        for (const auto& absence : absences_)
            if (auto added = add(absence); !added) return added;
        while (record < records_)
            if (auto ended = end(); !ended) return ended;
        return {};
    }

    void report() {
        for (const auto& planned : streams_) {
            const auto& stream = *planned.stream;
            ExportedStream written{.name = stream.name,
                                   .samples = stream.samples,
                                   .rate_hz = planned.slotRate_hz(record_s_),
                                   .gaps = stream.gapCount,
                                   .repeated = planned.counts.repeated,
                                   .dropped = planned.counts.dropped,
                                   .maxTimeError_s = planned.counts.maxTimeError_s};
            for (std::size_t c = 0; c < stream.channels.size(); ++c) {
                const auto& scale = planned.signals[c].scale;
                const auto infinite = stream.channels[c].infinite;
                written.channels.push_back({.name = stream.channels[c].name,
                                            .unit = stream.channels[c].unit,
                                            .exact = scale.exact,
                                            .step = scale.exact ? kNaN : scale.step,
                                            .maxError = scale.exact ? 0 : 0.5 * scale.step,
                                            .absent = stream.channels[c].absent + infinite});
                if (infinite > 0)
                    report_.leftOut.push_back(
                        {fmt::format("{} infinite values of {}", infinite, stream.channels[c].name),
                         fmt::format("{} holds finite values; they stand there as absent", name())});
            }
            report_.streams.push_back(std::move(written));
        }
        const auto because = fmt::format("{} has short annotations: when it was and how much", name());
        if (source_.trainCount() > 0) report_.leftOut.push_back({"other numbers of trains", because});
        if (!source_.trialRows().empty()) report_.leftOut.push_back({"numbers of trials", because});
        if (unplaced_ > 0)
            report_.leftOut.push_back({fmt::format("{} annotations", unplaced_),
                                       fmt::format("{} records with {} annotation signals hold {}", records_,
                                                   noteSignals_, records_ * noteSignals_)});
    }

    const ExportSource& source_;
    const std::size_t bytes_;  ///< of a sample
    const bool bdf_;
    ExportReport& report_;
    std::vector<PlannedStream> streams_;
    std::set<std::string> labels_;
    double record_s_ = 1, end_s_ = 0;
    std::uint64_t records_ = 1, notes_ = 0, unplaced_ = 0;
    std::size_t noteSignals_ = 1, notesAt_ = 0, recordBytes_ = 0;
    std::vector<Annotation> absences_;
    int file_ = -1;
};

template <bool bdf>
Result<void> writeEdf(const ExportSource& source, const std::filesystem::path& draft, ExportReport& report) {
    return EdfWriter(source, bdf, report).write(draft);
}

template <std::uint64_t bytes>
std::uint64_t sizeOfEdf(const ExportSource& source) {
    std::uint64_t all = kHeaderBytes * 20;
    for (const auto& stream : source.streams()) all += stream.samples * stream.channels.size() * bytes;
    return all + kAnnotationBytes * source.trainCount();
}

template <bool bdf>
ExportFormat formatOf() {
    constexpr std::string_view why =
        bdf ? "BDF holds no records of microseconds" : "EDF holds no records of microseconds";
    constexpr std::string_view rows = bdf ? "BDF holds short annotations, not what rows say in JSON"
                                          : "EDF holds short annotations, not what rows say in JSON";
    return {.name = bdf ? "bdf" : "edf",
            .title = bdf ? "BDF+: signals of 24 bits and annotations" : "EDF+: signals of 16 bits and annotations",
            .suffix = bdf ? ".bdf" : ".edf",
            .cannot = {{ExportContent::Captures, why}, {ExportContent::Records, rows}},
            .write = writeEdf<bdf>,
            .size = sizeOfEdf < bdf ? 3 : 2 > };
}

}  // namespace

const ExportFormat& edfExport() {
    static const ExportFormat format = formatOf<false>();
    return format;
}

const ExportFormat& bdfExport() {
    static const ExportFormat format = formatOf<true>();
    return format;
}

}  // namespace tacto
