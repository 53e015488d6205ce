// CapturePipe.h - from a capture to something that can be looked at, on a thread of its own: reading files, measuring,
// averaging, judging by a mask, building pyramids. Nothing here makes the window wait.
//
// Work is done in order. A bench that triggers faster than captures can be measured loses some of them here and reports
// it by skipped(); the session file is not this one's business.
//
// Thread-safety: the GUI thread; results arrive there.
#pragma once

#include <QObject>
#include <QString>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>

#include "app/gui/controller/SideWork.h"
#include "app/gui/scope/model/Trace.h"
#include "core/devices/Oscilloscope.h"
#include "core/measure/Capture.h"
#include "core/measure/CaptureAverage.h"

namespace tacto::gui {

/// The same samples at the same times, with the trigger where the line between two samples of the trigger's channel
/// rises through the level. The capture itself where no such crossing lies within a sample interval of the trigger that
/// the oscilloscope states: then that one stays. What was measured of it stays as well. An edge
/// stands still so from capture to capture, though the samples fall elsewhere on it each time.
[[nodiscard]] std::shared_ptr<const Capture> triggeredAtCrossing(std::shared_ptr<const Capture> capture,
                                                                 const ScopeSettings& settings);

class CapturePipe final : public QObject {
    Q_OBJECT
public:
    explicit CapturePipe(QObject* parent = nullptr);
    ~CapturePipe() override;  ///< waits for the work at hand

    /// How many of the bench's captures are averaged from now on; 1: no averaging. Another number restarts the mean.
    void setAverage(std::size_t captures);
    /// Judges the bench's captures from now on; null: none is.
    void setMask(std::shared_ptr<const CaptureMask> mask) { mask_ = std::move(mask); }
    /// Sets the trigger of the bench's captures: they are shown from where they cross its level. Nothing: from where
    /// the oscilloscope states.
    void setTrigger(const std::optional<ScopeSettings>& settings) { trigger_ = settings; }
    /// Sets what is asked of the output while the next captures are taken.
    void setAsked(const std::optional<AskedDrive>& asked) { asked_ = asked; }
    /// The next capture does not follow the last one: the oscilloscope was set again.
    void breakOff() { gap_ = true; }
    /// Begins with another bench or another load: nothing from before goes into a mean, and captures that are on their
    /// way are dropped.
    void beginAnew();
    void setMathOptions(const MathOptions& math) { mathOptions_ = math; }
    void take(std::shared_ptr<const Capture> capture, const QString& source = {});
    void open(const QString& path);
    /// Stops reading the file that is being read, and does not show it.
    void cancelOpen();
    /// Measures the same capture with the present math.
    void recalculate(const ShownPtr& shown);

    /// saveData() in the background; ends with saved() or failed().
    void save(const ShownPtr& shown, double from_s, double to_s, const QString& path);

    [[nodiscard]] bool opening() const noexcept { return opening_; }
    /// Progress of the file that is being read, 0 to 100. openingChanged() reports each.
    [[nodiscard]] int percentRead() const noexcept { return percentRead_; }
    [[nodiscard]] std::uint64_t skippedCaptures() const noexcept { return skipped_; }

signals:
    void prepared(tacto::gui::ShownPtr shown);
    void recalculated(tacto::gui::ShownPtr shown);
    void openingChanged();
    void saved(const QString& path);
    void failed(const QString& what);

private:
    void tellRead(double part);  // called on the thread that reads

    MathOptions mathOptions_;
    std::shared_ptr<const CaptureMask> mask_;
    std::optional<ScopeSettings> trigger_;
    std::optional<AskedDrive> asked_;
    CaptureAverage average_;   // the thread's
    bool gap_ = false;         // a capture was left out since the last
    std::uint64_t epoch_ = 1;  // numbers the bench's captures; another since beginAnew()
    int pending_ = 0;
    std::uint64_t skipped_ = 0;
    bool opening_ = false;
    std::uint64_t openNumber_ = 0;
    std::stop_source reading_;
    std::atomic<int> percentRead_{0};
    std::atomic<std::uint64_t> wantedOpen_{0};  // read by the thread: a reading given up is not measured
    SideWork work_;                             // last: it uses the others
};

/// Channels and what is calculated from them, from..to on the session's time base, as a capture file
/// (core/measure/CaptureFile.h). A file is replaced whole or not at all. Returns what went
/// wrong, as a sentence.
[[nodiscard]] std::optional<QString> saveData(const ShownCapture& shown, double from_s, double to_s,
                                              const QString& path);

}  // namespace tacto::gui
