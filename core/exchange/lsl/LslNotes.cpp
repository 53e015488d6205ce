#include "core/exchange/lsl/LslNotes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <thread>

#include "core/base/Printable.h"

namespace tacto {

namespace {

constexpr double kLook_s = 2;             // liblsl asks known computers one by one after half a second
constexpr double kTurn_s = 0.5;           // most that a call of the library waits
constexpr double kFirstCorrection_s = 5;  // a stream whose clock is not known by then is taken without its stamps
constexpr Instant kAhead = std::chrono::milliseconds(50);  // of a stamp, by the error of its correction
constexpr std::int32_t kLost = -2;                         // liblsl's error code of a stream that is gone
constexpr std::uint32_t kMaxStreams = 8;

/// How many notes may be taken now.
class Allowance {
public:
    [[nodiscard]] bool take(Instant now) {
        left_ = std::min<double>(LslNotes::kPerSecond, left_ + toSeconds(now - at_) * LslNotes::kPerSecond);
        at_ = now;
        if (left_ < 1) return false;
        left_ -= 1;
        return true;
    }

private:
    double left_ = LslNotes::kPerSecond;
    Instant at_{0};
};

/// The first `most` bytes, and no part of a character behind them.
std::string_view beginOf(std::string_view text, std::size_t most) {
    if (text.size() <= most) return text;
    for (int back = 0; back < 3 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U; ++back) --most;
    return text.substr(0, most);
}

/// For a library that fails without waiting.
void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(50)); }

struct CloseInlet {
    const LslLibrary* library;
    void operator()(LslInlet* inlet) const { library->destroyInlet(inlet); }
};
using Inlet = std::unique_ptr<LslInlet, CloseInlet>;

/// Returns the first stream found by its name, or null; `trouble` says why one was found and is not taken.
Inlet find(const LslLibrary& library, const std::string& stream, std::string& trouble) {
    std::array<LslInfo*, kMaxStreams> found{};
    const auto count = library.resolveByProperty(found.data(), kMaxStreams, "name", stream.c_str(), 1, kLook_s);
    Inlet inlet(nullptr, CloseInlet{&library});
    for (std::int32_t i = 0; i < std::min<std::int32_t>(count, kMaxStreams); ++i) {
        auto* info = found[static_cast<std::size_t>(i)];
        if (i == 0) {
            const auto format = library.channelFormat(info), channels = library.channelCount(info);
            if (format != LslLibrary::kString || channels != 1) {
                trouble = fmt::format("the stream \"{}\" holds {} (channels: {}); one channel of text is expected",
                                      stream, format == LslLibrary::kString ? "texts" : "numbers", channels);
            } else {
                trouble.clear();
                inlet.reset(library.createInlet(info, 10, 0, 1));
                if (!inlet) trouble = fmt::format("liblsl cannot open the stream \"{}\"", stream);
            }
        }
        library.destroyInfo(info);
    }
    return inlet;
}

}  // namespace

Result<void> LslNotes::checkName(std::string_view stream) {
    constexpr std::size_t kMaxName = 100;
    const bool plain = !stream.empty() && stream.size() <= kMaxName && printable(stream) == stream &&
                       stream.find_first_of("'\"") == std::string_view::npos;
    if (!plain)
        return fail(
            ErrorCode::InvalidArgument,
            "the LSL stream of markers is called \"{}\"; the name of a stream is expected, 1 to {} bytes without "
            "quotation marks",
            printable(stream.substr(0, kMaxName)), kMaxName);
    if (stream.starts_with("Tactoscope-"))
        return fail(ErrorCode::InvalidArgument,
                    "the LSL stream of markers is called \"{}\", as a stream of this program; another program's is "
                    "expected",
                    stream);
    return {};
}

LslNote LslNotes::noteOf(std::string_view text, double stamp_s, const LslClock& clock, Instant now) {
    LslNote note;
    const auto shown = printable(beginOf(text, kMaxBytes));
    note.text = beginOf(shown, kMaxBytes);
    note.shortened = text.size() > kMaxBytes || shown.size() > kMaxBytes;
    const double at_s = clock.sessionTime_s(stamp_s);
    note.stamped = std::isfinite(at_s) && at_s >= 0 && at_s <= toSeconds(now + kAhead);
    note.at = note.stamped ? std::min(toInstant(at_s), now) : now;
    return note;
}

LslNoteTally LslNotes::run(const LslLibrary& library, const std::string& stream, const LslClock& clock,
                           const Clock& session, const std::function<bool()>& ends,
                           const std::function<void(const LslNote&)>& take) {
    LslNoteTally tally;
    Allowance allowance;
    while (!ends()) {
        const auto inlet = find(library, stream, tally.trouble);
        if (!inlet) {
            pause();
            continue;
        }
        ++tally.streams;
        std::int32_t error = 0;
        double correction_s = NAN;
        const auto begun = session.now();
        bool opened = false;
        while (!ends() && error != kLost) {
            error = 0;
            if (!opened) {
                library.openStream(inlet.get(), kTurn_s, &error);
                opened = error == 0;
                if (!opened) {
                    pause();
                    continue;
                }
            }
            // The first takes a while, and the stream waits in the inlet; the library keeps it up to date.
            const double known_s = library.timeCorrection(inlet.get(), kTurn_s, &error);
            if (error == 0) correction_s = known_s;
            if (error == kLost) break;
            if (std::isnan(correction_s) && session.now() - begun < toInstant(kFirstCorrection_s)) {
                pause();
                continue;
            }
            char* text = nullptr;
            std::uint32_t length = 0;
            error = 0;
            const double stamp_s = library.pullText(inlet.get(), &text, &length, 1, kTurn_s, &error);
            if (text == nullptr) {
                if (error != 0) pause();
                continue;
            }
            const auto now = session.now();
            if (length == 0 || !allowance.take(now)) {
                ++tally.left;
            } else {
                const auto note = noteOf({text, length}, stamp_s + correction_s, clock, now);
                ++tally.taken;
                tally.unstamped += note.stamped ? 0 : 1;
                tally.shortened += note.shortened ? 1 : 0;
                take(note);
            }
            library.destroyText(text);
        }
    }
    return tally;
}

}  // namespace tacto
