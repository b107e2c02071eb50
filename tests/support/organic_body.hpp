#pragma once

#include "study/organic_body.hpp"
