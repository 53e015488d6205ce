// PhaseBar.h - the phase of a trial: get ready, trains, answer or rest; the present one is filled, with its time left.
#pragma once

#include <QWidget>
#include <optional>

namespace tacto::gui {

class PhaseBar final : public QWidget {
    Q_OBJECT
public:
    enum Phase { kNone = -1, kGetReady, kTrains, kAnswer, kRest };
    explicit PhaseBar(QWidget* parent = nullptr);
    /// `share`: the elapsed part of the phase, 0 to 1; nothing if the phase has no fixed end.
    void setPhase(Phase phase, std::optional<double> left_s = {}, std::optional<double> share = {});
    [[nodiscard]] Phase phase() const { return phase_; }
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return {1, sizeHint().height()}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    Phase phase_ = kNone;
    std::optional<double> left_s_, share_;
};

}  // namespace tacto::gui
