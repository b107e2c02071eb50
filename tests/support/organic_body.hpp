#pragma once

#include "study/error/organic_body.hpp"
