// CaptureStrip.h - the last captured waveform, small: voltage and current over time.
#pragma once

#include <filesystem>
#include <memory>
#include <qcustomplot.h>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/measure/Capture.h"

namespace tacto::gui {

class CaptureStrip final : public QCustomPlot {
    Q_OBJECT
public:
    explicit CaptureStrip(QWidget* parent = nullptr);
    /// Null empties it. What it is, where that is not the last capture, stands above it.
    void show(const std::shared_ptr<const Capture>& capture, const QString& title = {});
    [[nodiscard]] QString title() const { return title_->text(); }
    /// Whether no trace is drawn.
    [[nodiscard]] bool empty() const { return empty_->visible(); }

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void colour();
    /// Leaves out numbers that have no room.
    void thinTicks();
    QCPGraph* voltage_ = nullptr;
    QCPGraph* current_ = nullptr;
    QCPItemText* watermark_ = nullptr;
    QCPItemText* empty_ = nullptr;
    QCPTextElement* title_ = nullptr;
};

// Which train of a safety check's session shows what a limit was judged by on one of its loads.

/// The highest finite magnitude of the first channel in `unit` ("V", "A"); negative without one.
[[nodiscard]] double peakIn(const Capture& capture, std::string_view unit);

/// The capture with the highest peak among the commands on `load` ("500 ohm"): of voltage for a limit in volts, else of
/// current, and of voltage again where no current was measured. Null where none was captured on that load.
/// Errors: as SessionReader.
[[nodiscard]] Result<std::shared_ptr<const Capture>> strongestOn(const std::filesystem::path& session,
                                                                 const std::string& load, bool ofVoltage);

}  // namespace tacto::gui
