// MnemonicStyle.h - the program's style: Fusion, whose letters for Alt are underlined only while Alt is held, and whose
// icons grow with the text and stand a little before it, and whose layouts lie on the grid.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QProxyStyle>

namespace tacto::gui {

class MnemonicStyle final : public QProxyStyle {
    Q_OBJECT
public:
    MnemonicStyle();
    using QProxyStyle::polish;
    void polish(QWidget* widget) override;
    [[nodiscard]] int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                                QStyleHintReturn* returned) const override;
    [[nodiscard]] int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void underline(bool held);
    bool held_ = false;
};

}  // namespace tacto::gui
