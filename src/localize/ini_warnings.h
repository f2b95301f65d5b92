// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <string>
#include <vector>

namespace sigloc::detail
{
/// Whether sigloc or pf-localization reads such a key from [LocalizationExperiment].
bool isExperimentKey(const std::string& key);

/// Returns the keys of a section that neither sigloc nor pf-localization reads from
/// [LocalizationExperiment].
std::vector<std::string> unreadKeys(const mrpt::config::CConfigFileBase& ini,
                                    const std::string& section);

/// Returns a line for each of these that looks misspelt, and one for the others. They are no
/// error: pf-localization ignores them.
std::vector<std::string> warningsOfUnreadKeys(const mrpt::config::CConfigFileBase& ini,
                                              const std::string& section);

/// Returns a line on what the ini asks of pf-localization's particle filter and window, and sigloc
/// does not do; empty for nothing. Switches that are off ask for nothing.
std::string warningOfIgnoredKeys(const mrpt::config::CConfigFileBase& ini,
                                 const std::string& section, bool with_particles);

/// Returns a line for each line of the named sections that has no key, and for each of their keys
/// that the text of an ini gives several times.
std::vector<std::string> warningsOfLines(const std::string& text,
                                         const std::vector<std::string>& sections);
}  // namespace sigloc::detail
