// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>

#include <filesystem>

namespace sigloc
{
/// Writes a picture of three channels as a PNG. Throws as writeFile() does: MRPT's own writer gives
/// no reason, prints messages, and destroys the earlier picture.
void savePicture(const mrpt::img::CImage& picture, const std::filesystem::path& path);
}  // namespace sigloc
