// Style.h - the program's style, Fusion with three changes: letters for Alt are underlined only while Alt is held,
// icons grow with the text and stand a little before it, and layouts lie on the grid.
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

/// The wheel changes no setting that has not the focus, and gives none: a list, a number, a slider or the
/// tabs under a pointer that scrolls by stay as they are, and what they stand in scrolls (hazard H12).
class WheelGuard final : public QObject {
public:
    /// Installs it for every window of the program from now on; a second call does nothing.
    static void install();
    /// Whether a turn of the wheel would change its value.
    [[nodiscard]] static bool isSetting(const QWidget& widget);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    using QObject::QObject;
};

}  // namespace tacto::gui
