#include "app/report/PlotSheet.h"

#include "app/report/Fonts.h"

namespace tacto {

ConditionStyle conditionStyle(const QString& name, int index) {
    using S = QCPScatterStyle;
    static const std::map<QString, ConditionStyle> known{
        {"smooth-low", {QColor(0x56, 0xb4, 0xe9), Qt::DotLine, S::ssCircle}},
        {"smooth-high", {QColor(0x00, 0x72, 0xb2), Qt::DashLine, S::ssSquare}},
        {"rough-low", {QColor(0xe6, 0x9f, 0x00), Qt::DashDotLine, S::ssTriangle}},
        {"rough-high", {QColor(0xd5, 0x5e, 0x00), Qt::SolidLine, S::ssDiamond}}};
    if (const auto found = known.find(name); found != known.end()) return found->second;
    static const std::array<ConditionStyle, 8> further{
        {{ink::kCurrent, Qt::SolidLine, S::ssDiamond},
         {QColor(0xcc, 0x79, 0xa7), Qt::DashLine, S::ssCross},
         {QColor(0x33, 0x33, 0x33), Qt::DotLine, S::ssPlus},
         {QColor(0x7a, 0x7a, 0x7a), Qt::DashDotLine, S::ssStar},
         {QColor(0x56, 0xb4, 0xe9), Qt::SolidLine, S::ssTriangleInverted},
         {QColor(0xe6, 0x9f, 0x00), Qt::DashLine, S::ssCrossSquare},
         {QColor(0xd5, 0x5e, 0x00), Qt::DotLine, S::ssPlusCircle},
         {QColor(0x00, 0x72, 0xb2), Qt::DashDotLine, S::ssCrossCircle}}};
    return further[static_cast<std::size_t>(std::max(0, index)) % further.size()];
}

PlotSheet::PlotSheet(int width, int height, bool simulated)
    : plot_(std::make_unique<QCustomPlot>()), size_(width, height), simulated_(simulated) {
    plot_->setLocale(QLocale::c());
    plot_->setBackground(Qt::NoBrush);
    plot_->setAutoAddPlottableToLegend(false);
    plot_->plotLayout()->clear();
    plot_->plotLayout()->setRowSpacing(2);
    plot_->plotLayout()->setColumnSpacing(8);
    plot_->addLayer("watermark", plot_->layer("grid"), QCustomPlot::limAbove);
}

QCPAxisRect* PlotSheet::addAxes(int row, int column, QCPLayoutGrid* grid) {
    auto* axes = new QCPAxisRect(plot_.get(), false);
    axes->setMinimumMargins(QMargins(6, 4, 6, 4));
    for (const auto side : {QCPAxis::atLeft, QCPAxis::atBottom}) {
        auto* axis = axes->addAxis(side);
        axis->setLayer("axes");
        axis->grid()->setLayer("grid");
        axis->setTickLabelFont(textFont(10));
        axis->setLabelFont(textFont(11));
        axis->setTickLabelColor(ink::kText);
        axis->setLabelColor(ink::kText);
        axis->setBasePen(QPen(ink::kAxis, 1));
        axis->setTickPen(QPen(ink::kAxis, 1));
        axis->setSubTicks(false);
        axis->setTickLength(0, 4);
        axis->setTickLabelPadding(3);
        axis->setLabelPadding(4);
        axis->grid()->setPen(QPen(ink::kGrid, 1));
        axis->grid()->setZeroLinePen(Qt::NoPen);
        axis->setTicker(QSharedPointer<PlainTicker>::create(5));
    }
    (grid != nullptr ? grid : plot_->plotLayout())->addElement(row, column, axes);
    return axes;
}

void PlotSheet::addTitle(int row, int column, const QString& text, bool bold, QCPLayoutGrid* grid) {
    auto* title = new QCPTextElement(plot_.get(), text, textFont(11, bold));
    title->setTextColor(ink::kText);
    title->setTextFlags(Qt::AlignLeft | Qt::AlignVCenter);
    title->setMargins(QMargins(6, 3, 2, 1));
    title->setMaximumSize(QWIDGETSIZE_MAX, 20);
    (grid != nullptr ? grid : plot_->plotLayout())->addElement(row, column, title);
}

QCPLayoutGrid* PlotSheet::addGrid(int row, int column) {
    auto* grid = new QCPLayoutGrid;
    grid->setRowSpacing(0);
    grid->setColumnSpacing(6);
    plot_->plotLayout()->addElement(row, column, grid);
    return grid;
}

QCPItemText* PlotSheet::addNote(QCPAxisRect* axes, const QString& text, QPointF ratio, Qt::Alignment alignment) {
    auto* note = new QCPItemText(plot_.get());
    note->setClipToAxisRect(false);
    note->position->setAxisRect(axes);
    note->position->setType(QCPItemPosition::ptAxisRectRatio);
    note->position->setCoords(ratio);
    note->setPositionAlignment(alignment);
    note->setTextAlignment(alignment & Qt::AlignHorizontal_Mask);
    note->setText(text);
    note->setFont(textFont(10));
    note->setColor(ink::kText);
    return note;
}

void PlotSheet::explain(QCPAxisRect* axes, const QString& why) {
    addNote(axes, why, {0.5, 0.5})->setColor(ink::kQuiet);
    for (auto* axis : axes->axes()) {
        axis->setTicks(false);
        axis->setTickLabels(false);
        axis->grid()->setVisible(false);
    }
}

QCPLegend* PlotSheet::addLegend(int row, int column, int entriesPerLine) {
    auto* legend = new QCPLegend;
    // The legend gets its own grid and a spacer next to it: its maximum width would otherwise limit the whole column.
    auto* line = new QCPLayoutGrid;
    plot_->plotLayout()->addElement(row, column, line);
    line->addElement(0, 0, legend);
    auto* rest = new QCPTextElement(plot_.get(), QString(), textFont(10));
    rest->setMinimumSize(0, 0);
    rest->setMaximumSize(QWIDGETSIZE_MAX, 14);
    line->addElement(0, 1, rest);
    legend->setLayer("legend");
    legend->setBorderPen(Qt::NoPen);
    legend->setBrush(Qt::NoBrush);
    legend->setFont(textFont(10));
    legend->setTextColor(ink::kText);
    legend->setIconSize(24, 10);
    legend->setFillOrder(QCPLayoutGrid::foColumnsFirst, true);
    legend->setWrap(entriesPerLine);
    legend->setColumnSpacing(14);
    legend->setMargins(QMargins(8, 2, 8, 2));
    return legend;
}

void PlotSheet::fitLegend(QCPLegend* legend) {
    legend->setSizeConstraintRect(QCPLayoutElement::scrOuterRect);
    legend->setMaximumSize(legend->minimumOuterSizeHint());
}

void PlotSheet::watermark(QCPAxisRect* axes, int size) {
    if (!simulated_) return;
    auto* mark = addNote(axes, "SIMULATED", {0.5, 0.5});
    mark->setLayer("watermark");
    mark->setFont(textFont(size, true));
    mark->setColor(QColor(0xde, 0xe2, 0xe6));
    mark->setRotation(-18);
}

void PlotSheet::paint(QCPPainter& painter) {
    painter.save();
    painter.setModes(QCPPainter::pmVectorized | QCPPainter::pmNoCaching | QCPPainter::pmNonCosmetic);
    plot_->toPainter(&painter, size_.width(), size_.height());
    painter.restore();
}

QString PlainTicker::getTickLabel(double tick, const QLocale&, QChar, int) {
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step_) - 1e-9)), 0, 9);
    // A step such as 2.5 needs one decimal more than its magnitude suggests.
    const bool half = std::abs(step_ * std::pow(10.0, decimals) - std::round(step_ * std::pow(10.0, decimals))) > 1e-6;
    if (std::abs(tick) < step_ * 1e-6) tick = 0;
    QString text = QString::number(tick, 'f', decimals + (half ? 1 : 0));
    if (text.startsWith('-')) text.replace(0, 1, QStringLiteral("−"));
    return text + suffix_;
}

double PlainTicker::getTickStep(const QCPRange& range) {
    step_ = fixed_ > 0 ? fixed_ : QCPAxisTicker::getTickStep(range);
    return step_;
}

double roundBelow(double reach) {
    const double decade = std::pow(10.0, std::floor(std::log10(reach)));
    for (const double step : {8.0, 6.0, 5.0, 4.0, 3.0, 2.0}) {
        if (step * decade <= reach) return step * decade;
    }
    return decade;
}

QCPRange padded(double low, double high, double share) {
    if (!std::isfinite(low) || !std::isfinite(high)) return {0, 1};
    if (low > high) std::swap(low, high);
    double width = high - low;
    if (!(width > 1e-12 * std::max(std::abs(low), std::abs(high)))) {
        width = std::max(std::abs(high), 1e-9) * 0.2;
        return {low - width, high + width};
    }
    return {low - share * width, high + share * width};
}

}  // namespace tacto
