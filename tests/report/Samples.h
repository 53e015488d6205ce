// Samples.h - reports and figures for tests: a separability run as a bench would measure it.
//
// Thread-safety: the test's own thread.
#pragma once

#include <QByteArray>
#include <QJsonObject>
#include <filesystem>
#include <string>

#include "app/report/ReportModel.h"

namespace tacto::test {

/// The trials, conditions, captures and confusion of a separability run with `repeats` per condition.
QJsonObject planeJson(int repeats);
QJsonObject conditionsJson();
QJsonObject waveformsJson();
QJsonObject confusionJson();
QJsonObject exposureJson();
QJsonObject timelineJson(int frames);

/// `type` with nothing in it that could be drawn.
QJsonObject emptyFigureJson(const QString& type);

/// The figure as SVG.
std::string drawn(const QJsonObject& figure, bool simulated);

/// A whole report with a figure of every type and two tables.
ReportModel separabilityModel(bool simulated, int repeats = 25);

/// Text, page count and so on by a program of poppler-utils; empty when it fails.
std::string poppler(const std::string& command, const std::filesystem::path& pdf);
bool havePoppler();
inline constexpr const char* kNoPoppler = "poppler-utils is not installed: the PDF is not looked into";

QByteArray contentOfFile(const std::filesystem::path& path);

}  // namespace tacto::test
