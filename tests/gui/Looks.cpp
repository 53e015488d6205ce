#include "tests/gui/Looks.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLayout>
#include <QRegularExpression>
#include <QStyleOptionComboBox>
#include <QTabBar>
#include <QTest>
#include <QTextDocument>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/HeightLooks.h"
#include "tests/gui/Person.h"
#include "tests/gui/PlotLooks.h"
#include "tests/gui/RoomLooks.h"
#include "tests/support/Trials.h"

namespace tacto::test {

namespace {

double luminance(const QColor& colour) {
    const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

QString textOf(const QWidget& widget) {
    if (const auto* label = qobject_cast<const QLabel*>(&widget)) return label->text();
    if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) return button->text();
    return {};
}

QString nameOf(const QWidget& widget) {
    const auto text = textOf(widget);
    return QString("%1 %2 \"%3\"").arg(widget.metaObject()->className(), widget.objectName(), text);
}

QSize neededFor(const QWidget& widget) {
    const auto* label = qobject_cast<const QLabel*>(&widget);
    if (label != nullptr && label->wordWrap()) return {0, label->heightForWidth(label->width())};
    if (label != nullptr) return label->sizeHint();
    return widget.minimumSizeHint();
}

std::vector<const QWidget*> textsIn(const QWidget& in) {
    std::vector<const QWidget*> found;
    for (const auto* widget : in.findChildren<QWidget*>()) {
        if (widget->isVisible() && widget->window() == in.window() && !textOf(*widget).isEmpty())
            found.push_back(widget);
    }
    return found;
}

/// Returns the width of the widest word, which cannot be broken.
int widestWord(const QFontMetrics& metrics, const QString& text) {
    int widest = 0;
    for (const auto& word : text.split(QRegularExpression("\\s+")))
        widest = std::max(widest, metrics.horizontalAdvance(word));
    return widest;
}

QString cutText(const QWidget& widget, const QString& text, int has, int needs) {
    return QString("%1 %2 \"%3\": %4 of %5 px")
        .arg(widget.metaObject()->className(), widget.objectName(), text)
        .arg(has)
        .arg(needs);
}

void addCutChoice(const QComboBox& box, QStringList& cut) {
    QStyleOptionComboBox option;
    option.initFrom(&box);
    option.editable = box.isEditable();
    const auto field = box.style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, &box);
    const int needs = box.fontMetrics().horizontalAdvance(box.currentText());
    if (needs > field.width() + 1) cut << cutText(box, box.currentText(), field.width(), needs);
}

void addCutTabs(const QTabBar& tabs, QStringList& cut) {
    for (int i = 0; i < tabs.count(); ++i) {
        if (!tabs.isTabVisible(i)) continue;
        const auto text = tabs.tabText(i).remove('&');
        const auto place = tabs.tabRect(i);
        const bool upright = tabs.shape() == QTabBar::RoundedWest || tabs.shape() == QTabBar::RoundedEast;
        const int has = upright ? place.height() : place.intersected(tabs.rect()).width();
        const int needs = tabs.fontMetrics().horizontalAdvance(text);
        if (needs > has + 1) cut << cutText(tabs, text, has, needs);
    }
}

/// Adds titles that are cut off. Only sections that are fully in sight count; a title may have several lines.
void addCutTitles(const QHeaderView& header, QStringList& cut) {
    if (header.orientation() != Qt::Horizontal || header.model() == nullptr) return;
    for (int i = 0; i < header.count(); ++i) {
        const int left = header.sectionViewportPosition(i);
        if (header.isSectionHidden(i) || left < 0 || left + header.sectionSize(i) > header.viewport()->width())
            continue;
        const auto text = header.model()->headerData(i, Qt::Horizontal).toString();
        const int needs = widestWord(header.fontMetrics(), text);
        if (needs > header.sectionSize(i) + 1) cut << cutText(header, text, header.sectionSize(i), needs);
    }
}

}  // namespace

double contrast(const QColor& a, const QColor& b) {
    const auto [darker, lighter] = std::minmax({luminance(a), luminance(b)});
    return (lighter + 0.05) / (darker + 0.05);
}

int pixelsOf(const QImage& picture, const QColor& colour) {
    int found = 0;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) found += picture.pixelColor(x, y).rgb() == colour.rgb();
    }
    return found;
}

QStringList cutTexts(const QWidget& in) {
    QStringList cut;
    for (const auto* widget : textsIn(in)) {
        if (widget->width() < 2 || widget->height() < 2) {
            cut << QString("%1: %2x%3, not to be seen").arg(nameOf(*widget)).arg(widget->width()).arg(widget->height());
            continue;
        }
        const bool elides = dynamic_cast<const gui::ElidedLabel*>(widget) != nullptr ||
                            widget->sizePolicy().horizontalPolicy() == QSizePolicy::Ignored;
        if (elides) continue;
        const auto needed = neededFor(*widget);
        if (widget->width() + 1 < needed.width() || widget->height() + 1 < needed.height()) {
            cut << QString("%1: %2x%3 of %4x%5")
                       .arg(nameOf(*widget))
                       .arg(widget->width())
                       .arg(widget->height())
                       .arg(needed.width())
                       .arg(needed.height());
        }
    }
    for (const auto* widget : in.findChildren<QWidget*>()) {
        if (!widget->isVisible() || widget->window() != in.window()) continue;
        if (const auto* box = qobject_cast<const QComboBox*>(widget)) addCutChoice(*box, cut);
        if (const auto* tabs = qobject_cast<const QTabBar*>(widget)) addCutTabs(*tabs, cut);
        if (const auto* header = qobject_cast<const QHeaderView*>(widget)) addCutTitles(*header, cut);
    }
    return cut;
}

namespace {

/// True if the widget paints its whole background itself.
bool fills(const QWidget& widget) {
    if (widget.palette().color(widget.backgroundRole()).alpha() < 255) return false;
    return qobject_cast<const QAbstractButton*>(&widget) != nullptr || widget.autoFillBackground() ||
           widget.testAttribute(Qt::WA_StyledBackground);
}

/// Adds cells that have their own text colour and too little contrast.
void addPaleCells(const QAbstractItemView& view, QStringList& pale) {
    const auto* model = view.model();
    if (model == nullptr || !view.isEnabled()) return;
    const auto paper = view.palette().color(QPalette::Base);
    for (int row = 0; row < model->rowCount(); ++row) {
        for (int column = 0; column < model->columnCount(); ++column) {
            const auto cell = model->index(row, column);
            const auto text = cell.data().toString();
            const auto own = cell.data(Qt::ForegroundRole);
            if (text.isEmpty() || !own.isValid() || !cell.flags().testFlag(Qt::ItemIsEnabled)) continue;
            if (const auto ink = own.value<QBrush>().color(); contrast(ink, paper) < 4.5)
                pale << QString("\"%1\" in %2: %3 on %4").arg(text, nameOf(view), ink.name(), paper.name());
        }
    }
}

}  // namespace

QStringList paleTexts(const QWidget& in) {
    QStringList pale;
    for (const auto* widget : textsIn(in)) {
        if (!widget->isEnabled()) continue;
        // Uses the background as drawn: that of the nearest ancestor that fills its own.
        const auto* ground = widget;
        while (!fills(*ground) && !ground->isWindow() && ground->parentWidget() != nullptr)
            ground = ground->parentWidget();
        const auto ink = widget->palette().color(widget->foregroundRole());
        const auto paper = ground->palette().color(ground->backgroundRole());
        if (contrast(ink, paper) < 4.5)
            pale << QString("%1: %2 on %3, the ground of %4")
                        .arg(nameOf(*widget), ink.name(), paper.name(QColor::HexArgb), nameOf(*ground));
    }
    for (const auto* view : in.findChildren<QAbstractItemView*>()) {
        if (view->isVisibleTo(&in) && qobject_cast<const QHeaderView*>(view) == nullptr) addPaleCells(*view, pale);
    }
    return pale;
}

QStringList overlaps(const QWidget& in) {
    QStringList found;
    QList<const QWidget*> parents{&in};
    for (const auto* child : in.findChildren<QWidget*>()) parents << child;
    for (const auto* parent : parents) {
        const auto* layout = parent->layout();
        if (layout == nullptr || !parent->isVisible() || parent->window() != in.window()) continue;
        std::vector<const QWidget*> placed;
        for (const auto* child : parent->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
            // Includes the widgets of nested layouts: indexOf() knows only the layout's own widgets.
            if (child->isVisible() && !child->isWindow() && child->objectName() != "qt_qmainwindow_extended_splitter")
                placed.push_back(child);
        }
        for (std::size_t a = 0; a < placed.size(); ++a) {
            for (std::size_t b = a + 1; b < placed.size(); ++b) {
                const auto both = placed[a]->geometry().intersected(placed[b]->geometry());
                if (both.width() > 1 && both.height() > 1)
                    found << QString("%1 and %2 in %3: %4x%5")
                                 .arg(nameOf(*placed[a]), nameOf(*placed[b]), nameOf(*parent))
                                 .arg(both.width())
                                 .arg(both.height());
            }
        }
    }
    return found;
}

std::string faultsOf(const QWidget& in) {
    QStringList all;
    for (const auto& text : cutTexts(in)) all << "cut: " + text;
    for (const auto& text : paleTexts(in)) all << "pale: " + text;
    for (const auto& text : overlaps(in)) all << "over each other: " + text;
    for (const auto& text : cutCells(in)) all << "cut cell: " + text;
    for (const auto& text : cutFields(in)) all << "cut field: " + text;
    for (const auto& text : cutSideways(in)) all << "cut sideways: " + text;
    for (const auto& text : lowTexts(in)) all << "too low: " + text;
    for (const auto& text : cutBelow(in)) all << "cut below: " + text;
    for (const auto& text : beyondTheirPlace(in)) all << "cut by what is around: " + text;
    for (const auto& text : untoldElisions(in)) all << "elided: " + text;
    for (const auto& text : plotWordFaults(in)) all << "plot: " + text;
    for (const auto& text : palePlotWords(in)) all << "plot, pale: " + text;
    for (const auto& text : legendsOverData(in)) all << "plot: " + text;
    for (const auto& text : smallAxisTitles(in)) all << "plot, title of an axis: " + text;
    return all.join('\n').toStdString();
}

bool everyPairIsJudged() { return qEnvironmentVariableIsSet("TACTO_SHOTS") || trials<bool>({false, true, true}); }

std::vector<gui::Theme> bothThemes() {
    const auto present = gui::currentTheme();
    return {present, present == gui::Theme::Light ? gui::Theme::Dark : gui::Theme::Light};
}

std::vector<gui::Theme> themesAt(int percent) {
    auto themes = bothThemes();
    std::ranges::reverse(themes);
    if (percent > 100 && !everyPairIsJudged()) themes = {gui::currentTheme()};
    return themes;
}

std::vector<QSize> sizesIn(gui::Theme theme, std::vector<QSize> sizes) {
    if (theme == gui::Theme::Dark && !everyPairIsJudged()) sizes.resize(1);
    return sizes;
}

void looksRight(QWidget& widget, const QString& name, const LookedAtSizes& sizes, QWidget* frame) {
    auto& pictured = frame != nullptr ? *frame : widget;
    const auto size = pictured.size();
    for (const auto& [percent, sized] : {std::pair(100, sizes.at100), std::pair(200, sizes.at200)}) {
        gui::applyTextSize(percent);
        for (const auto theme : themesAt(percent)) {
            gui::applyTheme(theme);
            if (sized.isValid()) pictured.resize(sized);
            letLive(40);
            // Text grows before its place does, so wait.
            static_cast<void>(comesTrue([&] { return faultsOf(widget).empty(); }, 3000));
            EXPECT_EQ(faultsOf(widget), "") << name.toStdString() << " at " << percent << " %";
            shot(pictured, QString("%1-%2-%3").arg(name, theme == gui::Theme::Dark ? "dark" : "light").arg(percent));
        }
    }
    gui::applyTextSize(100);
    pictured.resize(size);
}

std::string widgetName(const QWidget& widget) {
    const auto said = widget.accessibleName().isEmpty() ? textOf(widget) : widget.accessibleName();
    return QString("%1 %2 \"%3\"").arg(widget.metaObject()->className(), widget.objectName(), said).toStdString();
}

std::string stepsBack(const std::vector<const QWidget*>& order) {
    std::string back;
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (order[i - 1]->isAncestorOf(order[i])) continue;  // goes into a page that scrolls
        const auto place = [](const QWidget* of) { return QRect(of->mapToGlobal(QPoint(0, 0)), of->size()); };
        const auto from = place(order[i - 1]);
        const auto to = place(order[i]);
        const bool sameColumn = from.left() < to.right() && to.left() < from.right();
        const bool sameRow = from.top() < to.center().y() && to.center().y() < from.bottom();
        const bool up = sameColumn && to.bottom() <= from.top();
        const bool left = sameRow && to.right() <= from.left();
        const bool upAndLeft = to.bottom() <= from.top() && to.right() <= from.left();
        if (up || left || upAndLeft) back += widgetName(*order[i - 1]) + " -> " + widgetName(*order[i]) + "\n";
    }
    return back;
}

}  // namespace tacto::test
