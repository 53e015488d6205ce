// Style.h - the program's style: Fusion with three changes. Letters for Alt are underlined only while Alt is held;
// icons grow with the text and have a wider gap to it; layouts use the grid.
#pragma once

#include <QProxyStyle>

class QWidget;

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

/// The wheel changes only a setting that has the focus, and never gives it the focus. While the user scrolls, lists,
/// numbers, sliders and tabs under the pointer keep their values, and the page around them scrolls (hazard H12), as it
/// does over a plot that does not zoom.
class WheelGuard final : public QObject {
public:
    /// Installs the guard for every window of the program; a second call does nothing.
    static void install();
    /// True if a turn of the wheel would change the widget's value.
    [[nodiscard]] static bool isSetting(const QWidget& widget);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    using QObject::QObject;
};

}  // namespace tacto::gui
