// PhaseBar.h - where a trial is: get ready, trains, answer, rest; the one under way filled, with the time left of it.
#pragma once

#include <QWidget>
#include <optional>

namespace tacto::gui {

class PhaseBar final : public QWidget {
    Q_OBJECT
public:
    enum Phase { kNone = -1, kGetReady, kTrains, kAnswer, kRest };
    explicit PhaseBar(QWidget* parent = nullptr);
    /// `share`: how much of it is gone, 0 to 1; nothing where it has no end of its own.
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
