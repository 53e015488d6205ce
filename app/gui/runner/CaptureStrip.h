// CaptureStrip.h - the last captured waveform, small: voltage and current over time.
//
// Thread-safety: the GUI thread.
#pragma once

#include <memory>
#include <qcustomplot.h>

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
    /// No more numbers than have room.
    void thinTicks();
    QCPGraph* voltage_ = nullptr;
    QCPGraph* current_ = nullptr;
    QCPItemText* watermark_ = nullptr;
    QCPItemText* empty_ = nullptr;
    QCPTextElement* title_ = nullptr;
};

}  // namespace tacto::gui
