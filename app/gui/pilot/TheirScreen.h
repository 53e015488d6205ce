// TheirScreen.h - what the participant's screen shows at this moment, small: where targets are, or the dot. The same
// drawing for every condition.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>

namespace tacto::gui {

class TheirScreen final : public QWidget {
    Q_OBJECT
public:
    enum class Shows { Nothing, Dot, Targets };
    explicit TheirScreen(QWidget* parent = nullptr);
    void setShows(Shows shows);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return {1, sizeHint().height()}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    Shows shows_ = Shows::Nothing;
};

}  // namespace tacto::gui
