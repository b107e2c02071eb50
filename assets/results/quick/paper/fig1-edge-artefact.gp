# Draws fig1-edge-artefact.svg and fig1-edge-artefact.png: gnuplot fig1-edge-artefact.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'fig1-edge-artefact.'.kind
unset border
unset tics
unset key
set size ratio -1
set xrange [-0.1:4.3]
set yrange [-0.85:1.25]
set object polygon from 0.6468,0.9502 to 0.7655,1.0432 to 0.5004,1.1290 to 0.6468,0.9502 fc rgb '#ded4bd' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.3643,1.0380 to 0.6468,0.9502 to 0.5004,1.1290 to 0.3643,1.0380 fc rgb '#ded5bd' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.6468,0.9502 to 1.0632,0.9610 to 0.7655,1.0432 to 0.6468,0.9502 fc rgb '#dfd5be' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.2549,0.9512 to 0.6468,0.9502 to 0.3643,1.0380 to 0.2549,0.9512 fc rgb '#dcd3bb' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.6284,0.0066 to 1.6406,0.2022 to 1.5370,0.1090 to 1.6284,0.0066 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.5222,-0.0840 to 1.6284,0.0066 to 1.5370,0.1090 to 1.5222,-0.0840 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.0252,-0.0193 to 0.2987,0.1090 to 0.0129,0.1891 to 0.0252,-0.0193 fc rgb '#9d9786' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.6468,0.9502 to 0.9434,0.8644 to 1.0632,0.9610 to 0.6468,0.9502 fc rgb '#dfd6be' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.2549,0.9512 to 0.5307,0.8633 to 0.6468,0.9502 to 0.2549,0.9512 fc rgb '#ddd3bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.0252,-0.0193 to 0.2963,-0.0905 to 0.2987,0.1090 to 0.0252,-0.0193 fc rgb '#9d9686' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.5370,0.1090 to 1.6406,0.2022 to 1.6351,0.3995 to 1.5370,0.1090 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.0129,0.1891 to 0.2987,0.1090 to 0.0185,0.3801 to 0.0129,0.1891 fc rgb '#999382' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.3987,-0.1717 to 1.5222,-0.0840 to 1.5370,0.1090 to 1.3987,-0.1717 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.2390,0.7769 to 1.3573,0.8700 to 1.0632,0.9610 to 1.2390,0.7769 fc rgb '#ded5bd' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.9434,0.8644 to 1.2390,0.7769 to 1.0632,0.9610 to 0.9434,0.8644 fc rgb '#dfd6be' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8268,0.7770 to 0.9434,0.8644 to 0.6468,0.9502 to 0.8268,0.7770 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5307,0.8633 to 0.8268,0.7770 to 0.6468,0.9502 to 0.5307,0.8633 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.4146,0.7762 to 0.5307,0.8633 to 0.2549,0.9512 to 0.4146,0.7762 fc rgb '#ddd3bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.2963,-0.0905 to 0.5904,-0.1815 to 0.2987,0.1090 to 0.2963,-0.0905 fc rgb '#9e9786' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.1314,0.8636 to 0.4146,0.7762 to 0.2549,0.9512 to 0.1314,0.8636 fc rgb '#ded4bd' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.5370,0.1090 to 1.6351,0.3995 to 1.5370,0.3034 to 1.5370,0.1090 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.2987,0.1090 to 0.2987,0.3025 to 0.0185,0.3801 to 0.2987,0.1090 fc rgb '#9a9483' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.6351,0.3995 to 1.6406,0.5904 to 1.5370,0.4978 to 1.6351,0.3995 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.3987,-0.1717 to 1.5370,0.1090 to 1.4204,0.0216 to 1.3987,-0.1717 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.0185,0.3801 to 0.2987,0.4962 to 0.0129,0.5773 to 0.0185,0.3801 fc rgb '#9c9585' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.5370,0.3034 to 1.6351,0.3995 to 1.5370,0.4978 to 1.5370,0.3034 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5904,-0.1815 to 0.5945,0.0214 to 0.2987,0.1090 to 0.5904,-0.1815 fc rgb '#9f9887' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.2390,0.7769 to 1.6284,0.7988 to 1.3573,0.8700 to 1.2390,0.7769 fc rgb '#dfd6be' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.0185,0.3801 to 0.2987,0.3025 to 0.2987,0.4962 to 0.0185,0.3801 fc rgb '#9a9483' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8268,0.7770 to 1.2390,0.7769 to 0.9434,0.8644 to 0.8268,0.7770 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.4146,0.7762 to 0.8268,0.7770 to 0.5307,0.8633 to 0.4146,0.7762 fc rgb '#ddd4bd' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.0252,0.7729 to 0.4146,0.7762 to 0.1314,0.8636 to 0.0252,0.7729 fc rgb '#dcd2bb' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.5370,0.4978 to 1.6406,0.5904 to 1.6284,0.7988 to 1.5370,0.4978 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.5370,0.1090 to 1.5370,0.3034 to 1.4204,0.2160 to 1.5370,0.1090 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.2987,0.1090 to 0.5945,0.2157 to 0.2987,0.3025 to 0.2987,0.1090 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.4204,0.0216 to 1.5370,0.1090 to 1.4204,0.2160 to 1.4204,0.0216 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.2987,0.1090 to 0.5945,0.0214 to 0.5945,0.2157 to 0.2987,0.1090 fc rgb '#9b9584' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.0129,0.5773 to 0.2987,0.4962 to 0.0252,0.7729 to 0.0129,0.5773 fc rgb '#989181' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.3987,-0.1717 to 1.4204,0.0216 to 1.3038,-0.0657 to 1.3987,-0.1717 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5904,-0.1815 to 0.8909,-0.0643 to 0.5945,0.0214 to 0.5904,-0.1815 fc rgb '#9f9887' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.2390,0.7769 to 1.5222,0.6991 to 1.6284,0.7988 to 1.2390,0.7769 fc rgb '#dfd6be' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.4204,0.2160 to 1.5370,0.3034 to 1.5370,0.4978 to 1.4204,0.2160 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.2987,0.3025 to 0.5945,0.2157 to 0.2987,0.4962 to 0.2987,0.3025 fc rgb '#9b9584' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.2893,-0.2585 to 1.3987,-0.1717 to 1.3038,-0.0657 to 1.2893,-0.2585 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8268,0.7770 to 1.1229,0.6900 to 1.2390,0.7769 to 0.8268,0.7770 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.4146,0.7762 to 0.7102,0.6897 to 0.8268,0.7770 to 0.4146,0.7762 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5904,-0.1815 to 0.8881,-0.2637 to 0.8909,-0.0643 to 0.5904,-0.1815 fc rgb '#9d9786' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.5370,0.4978 to 1.6284,0.7988 to 1.5222,0.6991 to 1.5370,0.4978 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.0252,0.7729 to 0.2963,0.6917 to 0.4146,0.7762 to 0.0252,0.7729 fc rgb '#dcd2bb' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.2987,0.4962 to 0.2963,0.6917 to 0.0252,0.7729 to 0.2987,0.4962 fc rgb '#989281' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.3038,-0.0657 to 1.4204,0.0216 to 1.4204,0.2160 to 1.3038,-0.0657 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5945,0.0214 to 0.8909,-0.0643 to 0.5945,0.2157 to 0.5945,0.0214 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.4204,0.2160 to 1.5370,0.4978 to 1.4204,0.4104 to 1.4204,0.2160 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5945,0.2157 to 0.5945,0.4101 to 0.2987,0.4962 to 0.5945,0.2157 fc rgb '#9b9584' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.3987,0.6164 to 1.5222,0.6991 to 1.2390,0.7769 to 1.3987,0.6164 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.1229,0.6900 to 1.3987,0.6164 to 1.2390,0.7769 to 1.1229,0.6900 fc rgb '#ded5bd' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.1532,-0.3494 to 1.2893,-0.2585 to 1.3038,-0.0657 to 1.1532,-0.3494 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.0068,0.6029 to 1.1229,0.6900 to 0.8268,0.7770 to 1.0068,0.6029 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.7102,0.6897 to 1.0068,0.6029 to 0.8268,0.7770 to 0.7102,0.6897 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8881,-0.2637 to 1.1532,-0.3494 to 0.8909,-0.0643 to 0.8881,-0.2637 fc rgb '#9e9787' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5904,0.6067 to 0.7102,0.6897 to 0.4146,0.7762 to 0.5904,0.6067 fc rgb '#dcd2bb' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.2963,0.6917 to 0.5904,0.6067 to 0.4146,0.7762 to 0.2963,0.6917 fc rgb '#ddd3bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.5370,0.4978 to 1.5222,0.6991 to 1.3987,0.6164 to 1.5370,0.4978 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.2987,0.4962 to 0.5904,0.6067 to 0.2963,0.6917 to 0.2987,0.4962 fc rgb '#999282' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8909,-0.0643 to 0.8908,0.1292 to 0.5945,0.2157 to 0.8909,-0.0643 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.3038,-0.0657 to 1.4204,0.2160 to 1.3038,0.1287 to 1.3038,-0.0657 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.4204,0.4104 to 1.5370,0.4978 to 1.3987,0.6164 to 1.4204,0.4104 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.2987,0.4962 to 0.5945,0.4101 to 0.5904,0.6067 to 0.2987,0.4962 fc rgb '#979181' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5945,0.2157 to 0.8909,0.3228 to 0.5945,0.4101 to 0.5945,0.2157 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.4204,0.2160 to 1.4204,0.4104 to 1.3038,0.3231 to 1.4204,0.2160 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.1532,-0.3494 to 1.1709,-0.1498 to 0.8909,-0.0643 to 1.1532,-0.3494 fc rgb '#9e9887' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.1532,-0.3494 to 1.3038,-0.0657 to 1.1709,-0.1498 to 1.1532,-0.3494 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5945,0.2157 to 0.8908,0.1292 to 0.8909,0.3228 to 0.5945,0.2157 fc rgb '#9b9584' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.3038,0.1287 to 1.4204,0.2160 to 1.3038,0.3231 to 1.3038,0.1287 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.0068,0.6029 to 1.3987,0.6164 to 1.1229,0.6900 to 1.0068,0.6029 fc rgb '#ded5bd' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5904,0.6067 to 1.0068,0.6029 to 0.7102,0.6897 to 0.5904,0.6067 fc rgb '#dcd2bb' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8909,-0.0643 to 1.1624,0.0453 to 0.8908,0.1292 to 0.8909,-0.0643 fc rgb '#9c9585' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.3038,-0.0657 to 1.3038,0.1287 to 1.1624,0.0453 to 1.3038,-0.0657 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.3038,0.3231 to 1.4204,0.4104 to 1.3987,0.6164 to 1.3038,0.3231 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5945,0.4101 to 0.8909,0.3228 to 0.5904,0.6067 to 0.5945,0.4101 fc rgb '#979181' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8909,-0.0643 to 1.1709,-0.1498 to 1.1624,0.0453 to 0.8909,-0.0643 fc rgb '#9a9383' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.1709,-0.1498 to 1.3038,-0.0657 to 1.1624,0.0453 to 1.1709,-0.1498 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8908,0.1292 to 1.1624,0.0453 to 0.8909,0.3228 to 0.8908,0.1292 fc rgb '#9c9585' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.1624,0.0453 to 1.3038,0.1287 to 1.3038,0.3231 to 1.1624,0.0453 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.0068,0.6029 to 1.2893,0.5246 to 1.3987,0.6164 to 1.0068,0.6029 fc rgb '#dfd5bd' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.5904,0.6067 to 0.8881,0.5185 to 1.0068,0.6029 to 0.5904,0.6067 fc rgb '#dcd3bb' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.3038,0.3231 to 1.3987,0.6164 to 1.2893,0.5246 to 1.3038,0.3231 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8909,0.3228 to 0.8881,0.5185 to 0.5904,0.6067 to 0.8909,0.3228 fc rgb '#989282' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.1624,0.0453 to 1.1709,0.2384 to 0.8909,0.3228 to 1.1624,0.0453 fc rgb '#9d9686' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.1624,0.0453 to 1.3038,0.3231 to 1.1709,0.2384 to 1.1624,0.0453 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.1532,0.4428 to 1.2893,0.5246 to 1.0068,0.6029 to 1.1532,0.4428 fc rgb '#ddd3bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8881,0.5185 to 1.1532,0.4428 to 1.0068,0.6029 to 0.8881,0.5185 fc rgb '#ddd3bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.3038,0.3231 to 1.2893,0.5246 to 1.1532,0.4428 to 1.3038,0.3231 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8909,0.3228 to 1.1532,0.4428 to 0.8881,0.5185 to 0.8909,0.3228 fc rgb '#999382' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 0.8909,0.3228 to 1.1709,0.2384 to 1.1532,0.4428 to 0.8909,0.3228 fc rgb '#999282' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 1.1709,0.2384 to 1.3038,0.3231 to 1.1532,0.4428 to 1.1709,0.2384 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set label 'constant-bem' at 0.950,-0.75 center
set object polygon from 2.7966,0.9528 to 2.9132,1.0401 to 2.6164,1.1270 to 2.7966,0.9528 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.4998,1.0396 to 2.7966,0.9528 to 2.6164,1.1270 to 2.4998,1.0396 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7966,0.9528 to 3.2100,0.9533 to 2.9132,1.0401 to 2.7966,0.9528 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.3832,0.9523 to 2.7966,0.9528 to 2.4998,1.0396 to 2.3832,0.9523 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.8036,0.0020 to 3.8036,0.1964 to 3.6870,0.1090 to 3.8036,0.0020 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.1500,0.0000 to 2.4468,0.1075 to 2.1500,0.1944 to 2.1500,0.0000 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7966,0.9528 to 3.0934,0.8659 to 3.2100,0.9533 to 2.7966,0.9528 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.3832,0.9523 to 2.6800,0.8654 to 2.7966,0.9528 to 2.3832,0.9523 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.6870,-0.0854 to 3.8036,0.0020 to 3.6870,0.1090 to 3.6870,-0.0854 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.1500,0.0000 to 2.4468,-0.0869 to 2.4468,0.1075 to 2.1500,0.0000 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.6870,0.1090 to 3.8036,0.1964 to 3.8036,0.3908 to 3.6870,0.1090 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.1500,0.1944 to 2.4468,0.1075 to 2.1500,0.3888 to 2.1500,0.1944 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3902,0.7790 to 3.5068,0.8664 to 3.2100,0.9533 to 3.3902,0.7790 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.0934,0.8659 to 3.3902,0.7790 to 3.2100,0.9533 to 3.0934,0.8659 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.9768,0.7785 to 3.0934,0.8659 to 2.7966,0.9528 to 2.9768,0.7785 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.6800,0.8654 to 2.9768,0.7785 to 2.7966,0.9528 to 2.6800,0.8654 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.5634,0.7780 to 2.6800,0.8654 to 2.3832,0.9523 to 2.5634,0.7780 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.2666,0.8649 to 2.5634,0.7780 to 2.3832,0.9523 to 2.2666,0.8649 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.5704,-0.1727 to 3.6870,-0.0854 to 3.6870,0.1090 to 3.5704,-0.1727 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.4468,-0.0869 to 2.7436,-0.1737 to 2.4468,0.1075 to 2.4468,-0.0869 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.6870,0.1090 to 3.8036,0.3908 to 3.6870,0.3034 to 3.6870,0.1090 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.4468,0.1075 to 2.4468,0.3019 to 2.1500,0.3888 to 2.4468,0.1075 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.8036,0.3908 to 3.8036,0.5851 to 3.6870,0.4978 to 3.8036,0.3908 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.1500,0.3888 to 2.4468,0.4963 to 2.1500,0.5832 to 2.1500,0.3888 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.5704,-0.1727 to 3.6870,0.1090 to 3.5704,0.0216 to 3.5704,-0.1727 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7436,-0.1737 to 2.7436,0.0206 to 2.4468,0.1075 to 2.7436,-0.1737 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.6870,0.3034 to 3.8036,0.3908 to 3.6870,0.4978 to 3.6870,0.3034 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.1500,0.3888 to 2.4468,0.3019 to 2.4468,0.4963 to 2.1500,0.3888 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3902,0.7790 to 3.8036,0.7795 to 3.5068,0.8664 to 3.3902,0.7790 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.9768,0.7785 to 3.3902,0.7790 to 3.0934,0.8659 to 2.9768,0.7785 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.5634,0.7780 to 2.9768,0.7785 to 2.6800,0.8654 to 2.5634,0.7780 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.1500,0.7775 to 2.5634,0.7780 to 2.2666,0.8649 to 2.1500,0.7775 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.6870,0.1090 to 3.6870,0.3034 to 3.5704,0.2160 to 3.6870,0.1090 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.4468,0.1075 to 2.7436,0.2150 to 2.4468,0.3019 to 2.4468,0.1075 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.6870,0.4978 to 3.8036,0.5851 to 3.8036,0.7795 to 3.6870,0.4978 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.1500,0.5832 to 2.4468,0.4963 to 2.1500,0.7775 to 2.1500,0.5832 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.5704,0.0216 to 3.6870,0.1090 to 3.5704,0.2160 to 3.5704,0.0216 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.4468,0.1075 to 2.7436,0.0206 to 2.7436,0.2150 to 2.4468,0.1075 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.5704,-0.1727 to 3.5704,0.0216 to 3.4538,-0.0657 to 3.5704,-0.1727 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7436,-0.1737 to 3.0404,-0.0662 to 2.7436,0.0206 to 2.7436,-0.1737 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.5704,0.2160 to 3.6870,0.3034 to 3.6870,0.4978 to 3.5704,0.2160 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.4468,0.3019 to 2.7436,0.2150 to 2.4468,0.4963 to 2.4468,0.3019 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3902,0.7790 to 3.6870,0.6922 to 3.8036,0.7795 to 3.3902,0.7790 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.9768,0.7785 to 3.2736,0.6917 to 3.3902,0.7790 to 2.9768,0.7785 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.5634,0.7780 to 2.8602,0.6912 to 2.9768,0.7785 to 2.5634,0.7780 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.1500,0.7775 to 2.4468,0.6907 to 2.5634,0.7780 to 2.1500,0.7775 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.4538,-0.2601 to 3.5704,-0.1727 to 3.4538,-0.0657 to 3.4538,-0.2601 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7436,-0.1737 to 3.0404,-0.2606 to 3.0404,-0.0662 to 2.7436,-0.1737 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.6870,0.4978 to 3.8036,0.7795 to 3.6870,0.6922 to 3.6870,0.4978 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.4468,0.4963 to 2.4468,0.6907 to 2.1500,0.7775 to 2.4468,0.4963 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.4538,-0.0657 to 3.5704,0.0216 to 3.5704,0.2160 to 3.4538,-0.0657 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7436,0.0206 to 3.0404,-0.0662 to 2.7436,0.2150 to 2.7436,0.0206 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.5704,0.2160 to 3.6870,0.4978 to 3.5704,0.4104 to 3.5704,0.2160 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7436,0.2150 to 2.7436,0.4094 to 2.4468,0.4963 to 2.7436,0.2150 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.5704,0.6048 to 3.6870,0.6922 to 3.3902,0.7790 to 3.5704,0.6048 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.2736,0.6917 to 3.5704,0.6048 to 3.3902,0.7790 to 3.2736,0.6917 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.1570,0.6043 to 3.2736,0.6917 to 2.9768,0.7785 to 3.1570,0.6043 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.8602,0.6912 to 3.1570,0.6043 to 2.9768,0.7785 to 2.8602,0.6912 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7436,0.6038 to 2.8602,0.6912 to 2.5634,0.7780 to 2.7436,0.6038 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.4468,0.6907 to 2.7436,0.6038 to 2.5634,0.7780 to 2.4468,0.6907 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3372,-0.3475 to 3.4538,-0.2601 to 3.4538,-0.0657 to 3.3372,-0.3475 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.0404,-0.2606 to 3.3372,-0.3475 to 3.0404,-0.0662 to 3.0404,-0.2606 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.6870,0.4978 to 3.6870,0.6922 to 3.5704,0.6048 to 3.6870,0.4978 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.4468,0.4963 to 2.7436,0.6038 to 2.4468,0.6907 to 2.4468,0.4963 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.4538,-0.0657 to 3.5704,0.2160 to 3.4538,0.1287 to 3.4538,-0.0657 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.0404,-0.0662 to 3.0404,0.1282 to 2.7436,0.2150 to 3.0404,-0.0662 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.5704,0.4104 to 3.6870,0.4978 to 3.5704,0.6048 to 3.5704,0.4104 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.4468,0.4963 to 2.7436,0.4094 to 2.7436,0.6038 to 2.4468,0.4963 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.5704,0.2160 to 3.5704,0.4104 to 3.4538,0.3231 to 3.5704,0.2160 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7436,0.2150 to 3.0404,0.3226 to 2.7436,0.4094 to 2.7436,0.2150 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3372,-0.3475 to 3.4538,-0.0657 to 3.3372,-0.1531 to 3.3372,-0.3475 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3372,-0.3475 to 3.3372,-0.1531 to 3.0404,-0.0662 to 3.3372,-0.3475 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.4538,0.1287 to 3.5704,0.2160 to 3.4538,0.3231 to 3.4538,0.1287 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7436,0.2150 to 3.0404,0.1282 to 3.0404,0.3226 to 2.7436,0.2150 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.1570,0.6043 to 3.5704,0.6048 to 3.2736,0.6917 to 3.1570,0.6043 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7436,0.6038 to 3.1570,0.6043 to 2.8602,0.6912 to 2.7436,0.6038 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.4538,-0.0657 to 3.4538,0.1287 to 3.3372,0.0413 to 3.4538,-0.0657 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.0404,-0.0662 to 3.3372,0.0413 to 3.0404,0.1282 to 3.0404,-0.0662 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.4538,0.3231 to 3.5704,0.4104 to 3.5704,0.6048 to 3.4538,0.3231 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7436,0.4094 to 3.0404,0.3226 to 2.7436,0.6038 to 2.7436,0.4094 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3372,-0.1531 to 3.4538,-0.0657 to 3.3372,0.0413 to 3.3372,-0.1531 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.0404,-0.0662 to 3.3372,-0.1531 to 3.3372,0.0413 to 3.0404,-0.0662 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3372,0.0413 to 3.4538,0.1287 to 3.4538,0.3231 to 3.3372,0.0413 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.0404,0.1282 to 3.3372,0.0413 to 3.0404,0.3226 to 3.0404,0.1282 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.1570,0.6043 to 3.4538,0.5174 to 3.5704,0.6048 to 3.1570,0.6043 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 2.7436,0.6038 to 3.0404,0.5169 to 3.1570,0.6043 to 2.7436,0.6038 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.4538,0.3231 to 3.5704,0.6048 to 3.4538,0.5174 to 3.4538,0.3231 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.0404,0.3226 to 3.0404,0.5169 to 2.7436,0.6038 to 3.0404,0.3226 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3372,0.0413 to 3.4538,0.3231 to 3.3372,0.2357 to 3.3372,0.0413 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3372,0.0413 to 3.3372,0.2357 to 3.0404,0.3226 to 3.3372,0.0413 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3372,0.4301 to 3.4538,0.5174 to 3.1570,0.6043 to 3.3372,0.4301 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.0404,0.5169 to 3.3372,0.4301 to 3.1570,0.6043 to 3.0404,0.5169 fc rgb '#ddd4bc' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.4538,0.3231 to 3.4538,0.5174 to 3.3372,0.4301 to 3.4538,0.3231 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.0404,0.3226 to 3.3372,0.4301 to 3.0404,0.5169 to 3.0404,0.3226 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.3372,0.2357 to 3.4538,0.3231 to 3.3372,0.4301 to 3.3372,0.2357 fc rgb '#6a655a' fs solid border lc rgb '#5a5a5a' lw 0.5
set object polygon from 3.0404,0.3226 to 3.3372,0.2357 to 3.3372,0.4301 to 3.0404,0.3226 fc rgb '#9b9484' fs solid border lc rgb '#5a5a5a' lw 0.5
set label 'linear-bem' at 3.100,-0.75 center
plot NaN notitle
unset output
reset
}
